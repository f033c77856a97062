// From where the path is seen: parallel projection, the third axis stays upright. Pure.
import type { Bounds } from './polyline';

export type Vector = [number, number, number];

export type ViewName = 'top' | 'front' | 'right' | 'oblique';

/// Radians: around the third axis, and above the horizon.
const kViews: Record<ViewName, { turn: number; height: number }> = {
  top: { turn: 0, height: Math.PI / 2 },
  front: { turn: 0, height: 0 },
  right: { turn: Math.PI / 2, height: 0 },
  oblique: { turn: Math.PI / 4, height: Math.atan(Math.SQRT1_2) },
};
const kMargin = 1.15;
const kMinSpan = 1e-4; // mm
const kMaxSpan = 1e7;

export interface Camera {
  center: Vector;
  /// Millimeters that the screen is high.
  span: number;
  turn: number;
  height: number;
}

export interface Screen {
  /// Pixels.
  width: number;
  height: number;
}

export const kFirstCamera: Camera = { center: [0, 0, 0], span: 100, ...kViews.oblique };

/// The directions to the right and up on the screen, and into it.
export function directionsOf({ turn, height }: Camera): { right: Vector; up: Vector; into: Vector } {
  const [c, s] = [Math.cos(turn), Math.sin(turn)];
  const [low, high] = [Math.cos(height), Math.sin(height)];
  return { right: [c, s, 0], up: [-s * high, c * high, low], into: [-s * low, c * low, -high] };
}

const dot = (a: Vector, b: Vector) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];

/// The columns of the matrix that takes millimeters to the device's cube, -1 to 1.
export function matrixOf(camera: Camera, screen: Screen, depth: number): Float32Array {
  const { right, up, into } = directionsOf(camera);
  const x = 2 / (camera.span * (screen.width / screen.height));
  const y = 2 / camera.span;
  const z = 1 / depth;
  const column = (i: 0 | 1 | 2) => [right[i] * x, up[i] * y, into[i] * z, 0];
  return new Float32Array([...column(0), ...column(1), ...column(2),
    -dot(right, camera.center) * x, -dot(up, camera.center) * y, -dot(into, camera.center) * z, 1]);
}

/// Pixels from the top left corner of the screen.
export function project(camera: Camera, screen: Screen, point: Vector): { x: number; y: number } {
  const { right, up } = directionsOf(camera);
  const from: Vector = [point[0] - camera.center[0], point[1] - camera.center[1], point[2] - camera.center[2]];
  const scale = screen.height / camera.span;
  return { x: screen.width / 2 + dot(from, right) * scale, y: screen.height / 2 - dot(from, up) * scale };
}

export function viewFrom(camera: Camera, name: ViewName): Camera {
  return { ...camera, ...kViews[name] };
}

/// By pixels of a drag: a width of the screen is half a revolution.
export function orbit(camera: Camera, screen: Screen, dx: number, dy: number): Camera {
  const step = Math.PI / screen.width;
  const height = Math.min(Math.PI / 2, Math.max(-Math.PI / 2, camera.height + dy * step));
  return { ...camera, turn: camera.turn - dx * step, height };
}

/// The path follows the pointer.
export function pan(camera: Camera, screen: Screen, dx: number, dy: number): Camera {
  const { right, up } = directionsOf(camera);
  const scale = camera.span / screen.height;
  const center = camera.center.map((value, i) => value - right[i]! * dx * scale + up[i]! * dy * scale) as Vector;
  return { ...camera, center };
}

/// What is under `at` stays there. A factor below 1 comes nearer.
export function zoom(camera: Camera, screen: Screen, factor: number, at = { x: screen.width / 2, y: screen.height / 2 }): Camera {
  const span = Math.min(kMaxSpan, Math.max(kMinSpan, camera.span * factor));
  const from = { x: at.x - screen.width / 2, y: at.y - screen.height / 2 };
  const moved = pan(camera, screen, -from.x, -from.y);
  return pan({ ...moved, span }, screen, from.x, from.y);
}

/// All of it, from the same side.
export function fit(camera: Camera, screen: Screen, bounds: Bounds): Camera {
  const { right, up } = directionsOf(camera);
  const center = bounds.least.map((value, i) => (value + bounds.most[i]!) / 2) as Vector;
  const size = bounds.least.map((value, i) => bounds.most[i]! - value);
  const along = (direction: Vector) => size.reduce((sum, value, i) => sum + value * Math.abs(direction[i]!), 0);
  const span = Math.max(along(up), along(right) * (screen.height / screen.width)) * kMargin;
  return { ...camera, center, span: Math.min(kMaxSpan, Math.max(kMinSpan, span || 1)) };
}

/// The point whose segment passes nearest to a place on the screen, within `reach` pixels; -1: none. A rapid has to be nearer.
export function pick(camera: Camera, screen: Screen, path: { length: number; positions: Float32Array; moves: Uint8Array },
  at: { x: number; y: number }, reach: number, showsRapids: boolean): number {
  const { right, up } = directionsOf(camera);
  const scale = screen.height / camera.span;
  const [cx, cy] = [dot(camera.center, right), dot(camera.center, up)];
  const [px, py] = [at.x - screen.width / 2, screen.height / 2 - at.y];
  const { positions, moves } = path;
  const kRapidHandicap = 3;
  let [best, nearest] = [reach * reach, -1];
  let [x0, y0] = [0, 0];
  for (let i = 0; i < path.length; ++i) {
    const [x, y, z] = [positions[3 * i]!, positions[3 * i + 1]!, positions[3 * i + 2]!];
    const x1 = (x * right[0] + y * right[1] + z * right[2] - cx) * scale;
    const y1 = (x * up[0] + y * up[1] + z * up[2] - cy) * scale;
    const isRapid = moves[i] === 0;
    if (i > 0 && (showsRapids || !isRapid)) {
      const [dx, dy] = [x1 - x0, y1 - y0];
      const length = dx * dx + dy * dy;
      const part = length > 0 ? Math.min(1, Math.max(0, ((px - x0) * dx + (py - y0) * dy) / length)) : 0;
      const distance = (px - x0 - part * dx) ** 2 + (py - y0 - part * dy) ** 2 + (isRapid ? kRapidHandicap : 0);
      if (distance < best) [best, nearest] = [distance, i];
    }
    [x0, y0] = [x1, y1];
  }
  return nearest;
}
