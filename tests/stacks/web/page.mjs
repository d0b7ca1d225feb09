// What runs in the browser: asks the server of browser.mjs for the inputs and hands it values or the reason why not.
import { evaluate as webgpu } from './webgpu.mjs';
import { evaluate as webgl } from './webgl.mjs';

const answer = (name, body) => fetch(`/answer/${name}`, { method: 'POST', body });
try {
    const { api, files } = await (await fetch('/inputs')).json();
    const inputs = {};
    for (const name of files) inputs[name] = await (await fetch(`/inputs/${name}`)).arrayBuffer();
    const run = api === 'webgpu' ? () => webgpu(navigator.gpu, inputs) : () => webgl(document.createElement('canvas'), inputs);
    if (api === 'webgpu' && !navigator.gpu) throw new Error('this browser has no WebGPU');
    const { values, version } = await run();
    await answer('values', values);
    await answer('version', version);
} catch (error) {
    await answer('failure', String(error));
}
