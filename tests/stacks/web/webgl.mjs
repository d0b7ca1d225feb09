// Runs the evaluation kernel as a fragment shader of WebGL 2, which has no storage buffers: arrays are textures.

const VERTEX = `#version 300 es
void main() {
    gl_Position = vec4(vec2(float((gl_VertexID & 1) * 4 - 1), float((gl_VertexID >> 1) * 4 - 1)), 0.0, 1.0);
}`;

/** As in webgpu.mjs, in a browser. */
export async function evaluate(canvas, inputs) {
    const gl = canvas.getContext('webgl2');
    if (!gl) throw new Error('no WebGL 2');
    if (!gl.getExtension('EXT_color_buffer_float')) throw new Error('no EXT_color_buffer_float');
    const program = gl.createProgram();
    for (const [kind, text] of [
        [gl.VERTEX_SHADER, VERTEX], [gl.FRAGMENT_SHADER, new TextDecoder().decode(inputs['program'])],
    ]) {
        const shader = gl.createShader(kind);
        gl.shaderSource(shader, text);
        gl.compileShader(shader);
        if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS)) throw new Error(gl.getShaderInfoLog(shader));
        gl.attachShader(program, shader);
    }
    gl.linkProgram(program);
    if (!gl.getProgramParameter(program, gl.LINK_STATUS)) throw new Error(gl.getProgramInfoLog(program));
    gl.useProgram(program);

    const width = 1024;
    const texture = (unit, target) => {
        const made = gl.createTexture();
        gl.activeTexture(gl.TEXTURE0 + unit);
        gl.bindTexture(target, made);
        gl.texParameteri(target, gl.TEXTURE_WRAP_S, gl.CLAMP_TO_EDGE);
        gl.texParameteri(target, gl.TEXTURE_WRAP_T, gl.CLAMP_TO_EDGE);
        const filter = target === gl.TEXTURE_2D_ARRAY ? gl.LINEAR : gl.NEAREST;
        gl.texParameteri(target, gl.TEXTURE_MIN_FILTER, filter);
        gl.texParameteri(target, gl.TEXTURE_MAG_FILTER, filter);
    };
    const array = (unit, name, contents, numbers, [internal, format, type]) => {
        const texels = Math.ceil(contents.length / numbers), height = Math.ceil(texels / width);
        const padded = new contents.constructor(width * height * numbers);
        padded.set(contents);
        texture(unit, gl.TEXTURE_2D);
        gl.texStorage2D(gl.TEXTURE_2D, 1, internal, width, height);
        gl.texSubImage2D(gl.TEXTURE_2D, 0, 0, 0, width, height, format, type, padded);
        gl.uniform1i(gl.getUniformLocation(program, name), unit);
    };
    const floats = [gl.RGBA32F, gl.RGBA, gl.FLOAT];
    array(0, 'surfaces', new Float32Array(inputs['surfaces.bin']), 4, floats);
    array(1, 'lights', new Uint32Array(inputs['lights.bin']), 4, [gl.RGBA32UI, gl.RGBA_INTEGER, gl.UNSIGNED_INT]);
    array(2, 'vertices', new Float32Array(inputs['vertices.bin']), 4, floats);
    const pairs = new Uint32Array(inputs['pairs.bin']);
    array(3, 'pairs', pairs, 2, [gl.RG32UI, gl.RG_INTEGER, gl.UNSIGNED_INT]);
    const texels = new Uint16Array(inputs['table.bin']), size = 64, layers = texels.length / (4 * size * size);
    texture(4, gl.TEXTURE_2D_ARRAY);
    gl.texStorage3D(gl.TEXTURE_2D_ARRAY, 1, gl.RGBA16F, size, size, layers);
    gl.texSubImage3D(gl.TEXTURE_2D_ARRAY, 0, 0, 0, 0, size, size, layers, gl.RGBA, gl.HALF_FLOAT, texels);
    gl.uniform1i(gl.getUniformLocation(program, 'table'), 4);

    const count = pairs.length / 2, height = Math.ceil(count / width);
    gl.uniform1ui(gl.getUniformLocation(program, 'count'), count);
    gl.bindFramebuffer(gl.FRAMEBUFFER, gl.createFramebuffer());
    gl.activeTexture(gl.TEXTURE5);
    const target = gl.createTexture();
    gl.bindTexture(gl.TEXTURE_2D, target);
    gl.texStorage2D(gl.TEXTURE_2D, 1, gl.RGBA32F, width, height);
    gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D, target, 0);
    if (gl.checkFramebufferStatus(gl.FRAMEBUFFER) !== gl.FRAMEBUFFER_COMPLETE) throw new Error('no framebuffer');
    gl.viewport(0, 0, width, height);
    gl.drawArrays(gl.TRIANGLES, 0, 3);
    const values = new Float32Array(width * height * 4);
    gl.readPixels(0, 0, width, height, gl.RGBA, gl.FLOAT, values);
    const error = gl.getError();
    if (error !== gl.NO_ERROR) throw new Error(`WebGL error ${error}`);
    const names = gl.getExtension('WEBGL_debug_renderer_info');
    const version = names ? gl.getParameter(names.UNMASKED_RENDERER_WEBGL) : gl.getParameter(gl.RENDERER);
    return { values: values.buffer.slice(0, 16 * count), version: `${version}; ${gl.getParameter(gl.VERSION)}` };
}
