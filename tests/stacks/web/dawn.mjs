// Evaluates on Dawn, Chromium's WebGPU, in Node.
//
//   node dawn.mjs MODULE FOLDER PROGRAM OUTPUT [options of Dawn ...]
//
// MODULE is the path of the package `webgpu`; the rest is as for browser.mjs.
import { readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { pathToFileURL } from 'node:url';

import { evaluate } from './webgpu.mjs';

const [module, folder, program, output, ...options] = process.argv.slice(2);
const { create, globals } = await import(pathToFileURL(module));
Object.assign(globalThis, globals);
// A plain copy: the reader's buffers share a larger one.
const read = path => new Uint8Array(readFileSync(path)).buffer;
const names = ['surfaces.bin', 'lights.bin', 'vertices.bin', 'pairs.bin', 'table.bin'];
const inputs = Object.fromEntries(names.map(name => [name, read(join(folder, name))]));
inputs['program'] = read(program);
try {
    const { values, version } = await evaluate(create(options), inputs);
    writeFileSync(output, new Uint8Array(values));
    console.log(version);
    process.exit(0);
} catch (error) {
    console.error(String(error));
    process.exit(1);
}
