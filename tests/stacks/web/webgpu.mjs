// Runs the evaluation kernel on a WebGPU implementation, in a browser or in Node.

/**
 * `gpu` is what `navigator.gpu` is in a browser; `inputs` holds the kernel's arrays and its text under the names of the
 * files that the harness writes. Returns four floats for each pair, and what the adapter says of itself.
 */
export async function evaluate(gpu, inputs) {
    // OpenGL is behind WebGPU's compatibility mode only.
    const adapter = await gpu.requestAdapter() ?? await gpu.requestAdapter({ featureLevel: 'compatibility' });
    if (!adapter) throw new Error('no WebGPU adapter');
    const device = await adapter.requestDevice();
    const failures = [];
    device.addEventListener?.('uncapturederror', event => failures.push(event.error.message));
    const module = device.createShaderModule({ code: new TextDecoder().decode(inputs['program']) });
    for (const message of (await module.getCompilationInfo()).messages) {
        if (message.type === 'error') throw new Error(`line ${message.lineNum}: ${message.message}`);
    }
    const pipeline = await device.createComputePipelineAsync({
        layout: 'auto', compute: { module, entryPoint: 'evaluate' },
    });

    const buffer = (contents, usage) => {
        const made = device.createBuffer({ size: contents.byteLength, usage: usage | GPUBufferUsage.COPY_DST });
        device.queue.writeBuffer(made, 0, contents);
        return made;
    };
    const names = ['surfaces.bin', 'lights.bin', 'vertices.bin', 'pairs.bin'];
    const resources = names.map(name => ({ buffer: buffer(inputs[name], GPUBufferUsage.STORAGE) }));
    const pairs = inputs['pairs.bin'].byteLength / 8;
    const output = device.createBuffer({ size: 16 * pairs, usage: GPUBufferUsage.STORAGE | GPUBufferUsage.COPY_SRC });
    resources.push({ buffer: output });

    const texels = inputs['table.bin'];
    const size = 64, layers = texels.byteLength / (8 * size * size);
    const texture = device.createTexture({
        size: [size, size, layers], format: 'rgba16float',
        usage: GPUTextureUsage.TEXTURE_BINDING | GPUTextureUsage.COPY_DST,
    });
    const layout = { bytesPerRow: 8 * size, rowsPerImage: size };
    device.queue.writeTexture({ texture }, texels, layout, [size, size, layers]);
    const table = texture.createView({ dimension: '2d-array' });
    const sampler = device.createSampler({ magFilter: 'linear', minFilter: 'linear' });
    const entries = [...resources, table, sampler].map((resource, binding) => ({ binding, resource }));

    const group = device.createBindGroup({ layout: pipeline.getBindGroupLayout(0), entries });
    const encoder = device.createCommandEncoder();
    const pass = encoder.beginComputePass();
    pass.setPipeline(pipeline);
    pass.setBindGroup(0, group);
    pass.dispatchWorkgroups(Math.ceil(pairs / 64));
    pass.end();
    const readback = device.createBuffer({ size: output.size, usage: GPUBufferUsage.MAP_READ | GPUBufferUsage.COPY_DST });
    encoder.copyBufferToBuffer(output, 0, readback, 0, output.size);
    device.queue.submit([encoder.finish()]);
    await readback.mapAsync(GPUMapMode.READ);
    const values = readback.getMappedRange().slice(0);
    if (failures.length > 0) throw new Error(failures.join('; '));
    const { vendor, architecture, device: model, description } = adapter.info;
    return { values, version: [vendor, architecture, model, description].filter(text => text).join(', ') };
}
