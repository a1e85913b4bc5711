// Draws panes with WebGL2. A pane: {x, y, width, height} in screen pixels from the top left, kind (0 to 3, see
// view.frag.glsl), a, b (pictures), error (bytes), split.

function makeGlRenderer(canvas, report, pictures, fragmentSource) {
  const gl = canvas.getContext("webgl2", {antialias: false, alpha: false, preserveDrawingBuffer: true});
  if (!gl || Math.max(report.width, report.height) > gl.getParameter(gl.MAX_TEXTURE_SIZE)) return null;

  const shader = (type, source) => {
    const s = gl.createShader(type);
    gl.shaderSource(s, source);
    gl.compileShader(s);
    if (!gl.getShaderParameter(s, gl.COMPILE_STATUS)) throw new Error(gl.getShaderInfoLog(s));
    return s;
  };
  const program = gl.createProgram();
  gl.attachShader(program, shader(gl.VERTEX_SHADER, `#version 300 es
    void main() { gl_Position = vec4(vec2(gl_VertexID == 1 ? 3 : -1, gl_VertexID == 2 ? 3 : -1), 0, 1); }`));
  gl.attachShader(program, shader(gl.FRAGMENT_SHADER, fragmentSource));
  gl.linkProgram(program);
  if (!gl.getProgramParameter(program, gl.LINK_STATUS)) throw new Error(gl.getProgramInfoLog(program));
  gl.useProgram(program);
  const at = name => gl.getUniformLocation(program, name);
  ["picture_a", "picture_b", "error_map", "color_map"].forEach((name, unit) => gl.uniform1i(at(name), unit));
  const uniforms = {};
  for (const name of ["kind", "pane_corner", "pane_size", "offset", "zoom", "split", "exposure", "tone",
                      "code_values"]) uniforms[name] = at(name);

  const texture = (internal, width, height, format, type, data) => {
    const t = gl.createTexture();
    gl.bindTexture(gl.TEXTURE_2D, t);
    gl.pixelStorei(gl.UNPACK_ALIGNMENT, 1);
    gl.texImage2D(gl.TEXTURE_2D, 0, internal, width, height, 0, format, type, data);
    for (const filter of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER])
      gl.texParameteri(gl.TEXTURE_2D, filter, gl.NEAREST);
    return t;
  };
  const map = texture(gl.RGB8, 256, 1, gl.RGB, gl.UNSIGNED_BYTE, report.colorMapBytes);
  const textures = new Map();  // uploaded when first shown
  const textureOf = (source, make) => {
    if (!textures.has(source)) textures.set(source, make());
    return textures.get(source);
  };
  const bind = (unit, t) => {
    gl.activeTexture(gl.TEXTURE0 + unit);
    gl.bindTexture(gl.TEXTURE_2D, t);
  };
  const {width, height} = report;
  const pictureTexture = p => textureOf(p.halves, () =>
    texture(gl.RGB16F, width, height, gl.RGB, gl.HALF_FLOAT, p.halves));

  return {
    name: "WebGL2",
    draw(panes, view) {
      gl.bindFramebuffer(gl.FRAMEBUFFER, null);
      gl.disable(gl.SCISSOR_TEST);
      gl.clearColor(0.106, 0.106, 0.106, 1);
      gl.clear(gl.COLOR_BUFFER_BIT);
      gl.enable(gl.SCISSOR_TEST);
      for (const pane of panes) {
        const bottom = canvas.height - pane.y - pane.height;
        const a = pictureTexture(pane.a), b = pictureTexture(pane.b);
        const error = pane.error
          ? textureOf(pane.error, () => texture(gl.R8, width, height, gl.RED, gl.UNSIGNED_BYTE, pane.error)) : map;
        [a, b, error, map].forEach((t, unit) => bind(unit, t));
        gl.viewport(pane.x, bottom, pane.width, pane.height);
        gl.scissor(pane.x, bottom, pane.width, pane.height);
        gl.uniform1i(uniforms.kind, pane.kind);
        gl.uniform2f(uniforms.pane_corner, pane.x, bottom);
        gl.uniform2f(uniforms.pane_size, pane.width, pane.height);
        gl.uniform2f(uniforms.offset, view.x, view.y);
        gl.uniform1f(uniforms.zoom, view.zoom);
        gl.uniform1f(uniforms.split, pane.split || 0);
        gl.uniform1f(uniforms.exposure, view.exposure);
        gl.uniform1i(uniforms.tone, view.tone);
        gl.uniform1i(uniforms.code_values, report.luminance ? 0 : 1);
        gl.drawArrays(gl.TRIANGLES, 0, 3);
      }
    },
    // The colour on the screen, RGB of 0 to 255, (x, y) from the top left.
    read(x, y) {
      const out = new Uint8Array(4);
      gl.readPixels(x, canvas.height - 1 - y, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, out);
      return Array.from(out.subarray(0, 3));
    },
  };
}
