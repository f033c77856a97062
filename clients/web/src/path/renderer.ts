// Draws a polyline by WebGL 2: one line strip, in which each segment has the color of the move to its end. Of a long path only each
// n-th point is drawn while it is moved: the buffers stay, the stride changes.
import { directionsOf, matrixOf, type Camera, type Screen } from './camera';
import type { Polyline } from './polyline';

export type Color = [number, number, number];
export interface Colors {
  /// As kMoves.
  moves: Color[];
  /// Of moves that are still to come, as kMoves.
  pending: Color[];
  selected: Color;
  axes: [Color, Color, Color];
}

export interface Scene {
  camera: Camera;
  colors: Colors;
  showsRapids: boolean;
  selection: Array<{ first: number; last: number }>;
  /// The last point that a machine has come to; null: no machine executes it.
  executed: number | null;
  /// While it is moved.
  isQuick: boolean;
}

const kQuickPoints = 100_000;
/// The axes are in a corner: pixels from the left and the lower edge, and their length.
export const kAxes = { corner: 56, length: 36 };
const kFloatBytes = 4;
const kMaxStride = 21; // points: WebGL allows 255 bytes from one to the next

const kVertexSource = `#version 300 es
uniform mat4 matrix;
uniform vec2 shift;
in vec3 position;
in uint move;
flat out uint kind;
void main() {
  kind = move;
  gl_Position = matrix * vec4(position, 1.0) + vec4(shift, 0.0, 0.0);
}`;

// Of a segment, the last point's kind applies: WebGL 2's provoking vertex.
const kFragmentSource = `#version 300 es
precision mediump float;
uniform vec3 colors[5];
uniform bool showsRapids;
flat in uint kind;
out vec4 color;
void main() {
  if (kind == 0u && !showsRapids) discard;
  color = vec4(colors[min(kind, 4u)], 1.0);
}`;

function compile(gl: WebGL2RenderingContext): WebGLProgram {
  const program = gl.createProgram()!;
  for (const [type, source] of [[gl.VERTEX_SHADER, kVertexSource], [gl.FRAGMENT_SHADER, kFragmentSource]] as const) {
    const shader = gl.createShader(type)!;
    gl.shaderSource(shader, source);
    gl.compileShader(shader);
    gl.attachShader(program, shader);
  }
  gl.bindAttribLocation(program, 0, 'position');
  gl.bindAttribLocation(program, 1, 'move');
  gl.linkProgram(program);
  if (!gl.getProgramParameter(program, gl.LINK_STATUS) && !gl.isContextLost()) throw new Error(gl.getProgramInfoLog(program) ?? 'WebGL');
  return program;
}

export class Renderer {
  private readonly program: WebGLProgram;
  private readonly positions: WebGLBuffer;
  private readonly moves: WebGLBuffer;
  private readonly axes: WebGLBuffer;
  private readonly places = new Map<string, WebGLUniformLocation | null>();
  private capacity = 0;
  private uploaded = 0;
  private generation = 0;

  /// `gl` has no content yet; after a lost context there is another renderer.
  constructor(private readonly gl: WebGL2RenderingContext) {
    this.program = compile(gl);
    this.positions = gl.createBuffer()!;
    this.moves = gl.createBuffer()!;
    this.axes = gl.createBuffer()!;
    for (const name of ['matrix', 'shift', 'colors', 'showsRapids']) this.places.set(name, gl.getUniformLocation(this.program, name));
    gl.enableVertexAttribArray(0);
  }

  draw(polyline: Polyline, screen: Screen, scene: Scene): void {
    const { gl } = this;
    this.upload(polyline);
    gl.viewport(0, 0, gl.drawingBufferWidth, gl.drawingBufferHeight);
    gl.clearColor(0, 0, 0, 0);
    gl.clear(gl.COLOR_BUFFER_BIT);
    gl.useProgram(this.program);
    gl.uniform1i(this.places.get('showsRapids')!, scene.showsRapids ? 1 : 0);
    this.setMatrix(scene.camera, screen, depthOf(polyline, scene.camera));
    this.drawPath(polyline, scene);
    this.drawSelection(screen, scene);
    this.drawAxes(screen, scene);
  }

  private upload(polyline: Polyline): void {
    const { gl } = this;
    if (polyline.generation !== this.generation) this.uploaded = 0;
    this.generation = polyline.generation;
    if (this.capacity !== polyline.moves.length) {
      this.capacity = polyline.moves.length;
      this.uploaded = 0;
      gl.bindBuffer(gl.ARRAY_BUFFER, this.positions);
      gl.bufferData(gl.ARRAY_BUFFER, 3 * kFloatBytes * this.capacity, gl.DYNAMIC_DRAW);
      gl.bindBuffer(gl.ARRAY_BUFFER, this.moves);
      gl.bufferData(gl.ARRAY_BUFFER, this.capacity, gl.DYNAMIC_DRAW);
    }
    if (this.uploaded === polyline.length) return;
    gl.bindBuffer(gl.ARRAY_BUFFER, this.positions);
    gl.bufferSubData(gl.ARRAY_BUFFER, 3 * kFloatBytes * this.uploaded, polyline.positions.subarray(3 * this.uploaded, 3 * polyline.length));
    gl.bindBuffer(gl.ARRAY_BUFFER, this.moves);
    gl.bufferSubData(gl.ARRAY_BUFFER, this.uploaded, polyline.moves.subarray(this.uploaded, polyline.length));
    this.uploaded = polyline.length;
  }

  private usePoints(stride: number): void {
    const { gl } = this;
    gl.bindBuffer(gl.ARRAY_BUFFER, this.positions);
    gl.vertexAttribPointer(0, 3, gl.FLOAT, false, 3 * kFloatBytes * stride, 0);
    gl.enableVertexAttribArray(1);
    gl.bindBuffer(gl.ARRAY_BUFFER, this.moves);
    gl.vertexAttribIPointer(1, 1, gl.UNSIGNED_BYTE, stride, 0);
  }

  private setColors(colors: Color[], shift: [number, number] = [0, 0]): void {
    this.gl.uniform3fv(this.places.get('colors')!, new Float32Array(colors.flat()));
    this.gl.uniform2f(this.places.get('shift')!, ...shift);
  }

  private drawPath(polyline: Polyline, scene: Scene): void {
    const wanted = scene.isQuick ? Math.ceil(polyline.length / kQuickPoints) : 1;
    const stride = Math.min(kMaxStride, Math.max(1, wanted));
    const points = Math.floor(polyline.length / stride);
    const past = scene.executed === null ? points : Math.min(points, Math.floor(scene.executed / stride) + 1);
    this.usePoints(stride);
    if (past < points) {
      this.setColors(scene.colors.pending);
      this.gl.drawArrays(this.gl.LINE_STRIP, Math.max(0, past - 1), points - Math.max(0, past - 1));
    }
    this.setColors(scene.colors.moves);
    this.gl.drawArrays(this.gl.LINE_STRIP, 0, past);
  }

  /// Wider than a pixel, which no browser draws by itself: the same lines again, a pixel beside.
  private drawSelection(screen: Screen, scene: Scene): void {
    const { gl } = this;
    this.usePoints(1);
    gl.uniform1i(this.places.get('showsRapids')!, 1);
    const color = Array.from({ length: 5 }, () => scene.colors.selected);
    const [x, y] = [2 / screen.width, 2 / screen.height];
    for (const [right, up] of [[0, 0], [1, 0], [-1, 0], [0, 1], [0, -1]] as const) {
      this.setColors(color, [right * x, up * y]);
      for (const { first, last } of scene.selection) gl.drawArrays(gl.LINE_STRIP, first - 1, last - first + 2);
    }
  }

  private setMatrix(camera: Camera, screen: Screen, depth: number): void {
    this.gl.uniformMatrix4fv(this.places.get('matrix')!, false, matrixOf(camera, screen, depth));
  }

  private drawAxes(screen: Screen, scene: Scene): void {
    const { gl } = this;
    const { corner, length } = kAxes;
    this.setMatrix(cameraOfAxes(scene.camera, screen), screen, screen.height);
    const shift: [number, number] = [2 * corner / screen.width - 1, 2 * corner / screen.height - 1];
    gl.bindBuffer(gl.ARRAY_BUFFER, this.axes);
    gl.bufferData(gl.ARRAY_BUFFER, new Float32Array([0, 0, 0, length, 0, 0, 0, 0, 0, 0, length, 0, 0, 0, 0, 0, 0, length]), gl.DYNAMIC_DRAW);
    gl.vertexAttribPointer(0, 3, gl.FLOAT, false, 0, 0);
    gl.disableVertexAttribArray(1);
    gl.vertexAttribI4ui(1, 1, 0, 0, 0);
    for (const [i, color] of scene.colors.axes.entries()) {
      this.setColors([color, color, color, color, color], shift);
      gl.drawArrays(gl.LINES, 2 * i, 2);
    }
  }
}

/// The same directions, a millimeter a pixel.
export function cameraOfAxes(camera: Camera, screen: Screen): Camera {
  return { ...camera, center: [0, 0, 0], span: screen.height };
}

/// Half of what lies in front of and after the center, so that nothing is cut off.
function depthOf(polyline: Polyline, camera: Camera): number {
  const bounds = polyline.bounds();
  if (!bounds) return 1e4;
  const { into } = directionsOf(camera);
  const far = bounds.least.map((value, i) => Math.max(Math.abs(value - camera.center[i]!), Math.abs(bounds.most[i]! - camera.center[i]!), Math.abs(camera.center[i]!)));
  return 2 * (far.reduce((sum, value, i) => sum + value * Math.abs(into[i]!), 0) + camera.span) + 1;
}
