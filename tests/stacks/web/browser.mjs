// Evaluates in a browser.
//
//   node browser.mjs API FOLDER PROGRAM OUTPUT BROWSER [arguments of the browser ...]
//
// API is webgpu or webgl. FOLDER holds the kernel's arrays, OUTPUT receives the values; what the browser says of its
// device goes to standard output. The page is served to this machine alone.
import { spawn } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { createServer } from 'node:http';
import { tmpdir } from 'node:os';
import { join } from 'node:path';

const [api, folder, program, output, browser, ...flags] = process.argv.slice(2);
const names = ['surfaces.bin', 'lights.bin', 'vertices.bin', 'pairs.bin', 'table.bin'];
const inputs = Object.fromEntries(names.map(name => [name, readFileSync(join(folder, name))]));
inputs['program'] = readFileSync(program);
const scripts = Object.fromEntries(['page.mjs', 'webgpu.mjs', 'webgl.mjs'].map(name =>
    [`/${name}`, readFileSync(new URL(name, import.meta.url))]));

const profile = mkdtempSync(join(tmpdir(), 'softbox-browser-'));
let child, said = '';
const finish = (status, text) => {
    (status === 0 ? process.stdout : process.stderr).write(`${text}\n`);
    child.on('exit', () => {
        // Processes of the browser's own may still be ending.
        rmSync(profile, { recursive: true, force: true, maxRetries: 20, retryDelay: 200 });
        process.exit(status);
    });
    // With all processes of its own, which write to the profile too.
    process.kill(-child.pid, 'SIGKILL');
};

const server = createServer((request, response) => {
    const send = (kind, body) => response.writeHead(200, { 'Content-Type': kind }).end(body);
    const path = request.url;
    if (path === '/') return send('text/html', '<!doctype html><script type="module" src="page.mjs"></script>');
    if (path === '/inputs') return send('application/json', JSON.stringify({ api, files: Object.keys(inputs) }));
    if (scripts[path]) return send('text/javascript', scripts[path]);
    if (path.startsWith('/inputs/')) return send('application/octet-stream', inputs[path.slice('/inputs/'.length)]);
    if (!path.startsWith('/answer/')) return response.writeHead(404).end();
    const parts = [];
    request.on('data', part => parts.push(part));
    request.on('end', () => {
        send('text/plain', '');
        const body = Buffer.concat(parts);
        if (path === '/answer/values') writeFileSync(output, body);
        if (path === '/answer/version') finish(0, body.toString());
        if (path === '/answer/failure') finish(1, body.toString());
    });
});
server.listen(0, '127.0.0.1', () => {
    const page = `http://127.0.0.1:${server.address().port}/`;
    child = spawn(browser, [...flags.map(flag => flag.replaceAll('PROFILE', profile)), page], { detached: true });
    child.stderr.on('data', part => { said += part; });
    child.on('error', error => { process.stderr.write(`${browser}: ${error.message}\n`); process.exit(1); });
    setTimeout(() => finish(1, `no answer within two minutes: ${said.slice(-1500)}`), 120_000);
});
