// The logic of the tool path: its bytes in any pieces, the bounded line, the camera, the search for what was pressed.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { fit, kFirstCamera, matrixOf, orbit, pan, pick, project, viewFrom, zoom, type Camera } from '../../src/path/camera';
import { PathDecoder, type PathNote } from '../../src/path/decoder';
import { Polyline } from '../../src/path/polyline';

function numberBytes(value: bigint): number[] {
  const bytes: number[] = [];
  for (; value >= 0x80n; value >>= 7n) bytes.push(Number(value & 0x7fn) | 0x80);
  return [...bytes, Number(value)];
}
const zigzag = (value: number) => (value >= 0 ? 2n * BigInt(value) : -2n * BigInt(value) - 1n);
function frame(kind: string, content: number[]): number[] {
  return [kind.charCodeAt(0), ...[0, 8, 16, 24].map((shift) => (content.length >> shift) & 0xff), ...content];
}
function pointBytes(line: number, move: number, offset: number, x: number, y: number, z: number): number[] {
  return [...numberBytes((zigzag(line) << 3n) | BigInt(move)), ...[offset, x, y, z].flatMap((value) => numberBytes(zigzag(value)))];
}
const json = (value: object) => frame('J', [...new TextEncoder().encode(JSON.stringify(value))]);

const kBytes = new Uint8Array([
  ...json({ kind: 'begin', program: 'O1', revision: 1, control: 'fanuc', size: 9, lathe: false }),
  ...frame('P', [...pointBytes(0, 0, 0, 0, 0, 0), ...pointBytes(3, 1, 5_000_000_000, -1, 64, 1_000_000_000_000)]),
  ...frame('P', pointBytes(-2, 2, -4_999_999_000, 1, -64, 0)),
  ...json({ kind: 'progress', blocks: 2, points: 3 }),
]);

test('points and notes are the same whatever the pieces', () => {
  for (const size of [1, 2, 7, kBytes.length]) {
    const polyline = new Polyline();
    const notes: PathNote[] = [];
    const decoder = new PathDecoder(polyline, (note) => notes.push(note));
    for (let at = 0; at < kBytes.length; at += size) decoder.take(kBytes.subarray(at, at + size));
    assert.equal(polyline.length, 3);
    assert.deepEqual([...polyline.lines.subarray(0, 3)], [1, 4, 2]);
    assert.deepEqual([...polyline.offsets.subarray(0, 3)], [0, 5_000_000_000, 1000]);
    assert.deepEqual([...polyline.moves.subarray(0, 3)], [0, 1, 2]);
    assert.deepEqual([...polyline.positions.subarray(3, 6)], [-0.001, 0.064, 1e9].map(Math.fround));
    assert.deepEqual(notes.map((note) => note.kind), ['begin', 'progress']);
  }
});

test('a lathe is shown with Z to the right and X up', () => {
  const polyline = new Polyline();
  const decoder = new PathDecoder(polyline, () => {});
  decoder.take(new Uint8Array([...json({ kind: 'begin', lathe: true }), ...frame('P', pointBytes(0, 1, 0, 1000, 2000, 3000))]));
  assert.deepEqual([...polyline.positions.subarray(0, 3)], [3, 1, 2]);
});

test('bytes that are no path are refused', () => {
  const decoder = new PathDecoder(new Polyline(), () => {});
  assert.throws(() => decoder.take(new Uint8Array(frame('X', []))));
  assert.throws(() => new PathDecoder(new Polyline(), () => {}).take(new Uint8Array([0x50, 255, 255, 255, 255, 0])));
});

test('a long path stays bounded, and near itself', () => {
  const polyline = new Polyline(4096);
  const kCount = 100_000;
  for (let i = 0; i <= kCount; ++i) polyline.add(i / 100, Math.sin(i / 1000) * 50, 0, 1, i + 1, i);
  assert.ok(polyline.length <= 4096, `${polyline.length}`);
  assert.ok(polyline.length > 100, `${polyline.length}`);
  assert.ok(polyline.tolerance > 0 && polyline.tolerance < 1, `${polyline.tolerance}`);
  assert.equal(polyline.lines[0], 1);
  assert.ok(polyline.lines[polyline.length - 1]! > kCount - 4096);
  for (let i = 1; i < polyline.length; ++i) {
    const x = polyline.positions[3 * i]!;
    assert.ok(Math.abs(polyline.positions[3 * i + 1]! - Math.sin(x / 10) * 50) < 1e-3); // points stay, or are left out
    assert.ok(polyline.lines[i]! > polyline.lines[i - 1]!);
  }
});

test('a path that cannot be made coarser is bounded too', () => {
  const polyline = new Polyline(64);
  for (let i = 0; i < 1000; ++i) polyline.add(i % 2 === 0 ? 0 : NaN, i % 3, i % 5, i % 2, i, i);
  assert.ok(polyline.length > 0 && polyline.length <= 64);
});

test('a line is found on the path, with all its passes', () => {
  const polyline = new Polyline();
  for (const line of [1, 3, 3, 5, 3]) polyline.add(line, 0, 0, 1, line, 0);
  assert.equal(polyline.findLine(3), 1);
  assert.equal(polyline.findLine(4), 3);
  assert.equal(polyline.findLine(6), -1);
  assert.deepEqual(polyline.runsOf(3), [{ first: 1, last: 2 }, { first: 4, last: 4 }]);
});

const kScreen = { width: 800, height: 400 };
const kBounds = { least: [0, 0, 0] as [number, number, number], most: [100, 50, 20] as [number, number, number] };
const near = (a: number, b: number) => assert.ok(Math.abs(a - b) < 1e-6 * Math.max(1, Math.abs(b)), `${a} ${b}`);

test('the views show what their names say', () => {
  const at = (name: 'top' | 'front' | 'right', point: [number, number, number]) => project({ ...viewFrom(kFirstCamera, name), center: [0, 0, 0] }, kScreen, point);
  assert.ok(at('top', [1, 0, 0]).x > 400 && at('top', [0, 1, 0]).y < 200);
  assert.ok(at('front', [1, 0, 0]).x > 400 && at('front', [0, 0, 1]).y < 200);
  assert.ok(at('right', [0, 1, 0]).x > 400 && at('right', [0, 0, 1]).y < 200);
});

test('fit shows every corner, from any side, and the graphics card computes the same', () => {
  for (const turn of [0, 1, 2, 3]) {
    const camera = fit({ ...kFirstCamera, turn, height: turn / 3 }, kScreen, kBounds);
    const matrix = matrixOf(camera, kScreen, 1000);
    for (const x of [0, 100]) {
      for (const y of [0, 50]) {
        const shown = project(camera, kScreen, [x, y, 20]);
        assert.ok(shown.x >= 0 && shown.x <= 800 && shown.y >= 0 && shown.y <= 400);
        const clip = (row: number) => matrix[row]! * x + matrix[4 + row]! * y + matrix[8 + row]! * 20 + matrix[12 + row]!;
        assert.ok(Math.abs((clip(0) + 1) * 400 - shown.x) < 0.01 && Math.abs((1 - clip(1)) * 200 - shown.y) < 0.01);
      }
    }
  }
});

test('pan follows the pointer, and zoom keeps what is under it', () => {
  const camera: Camera = orbit(fit(kFirstCamera, kScreen, kBounds), kScreen, 30, -20);
  const before = project(camera, kScreen, [10, 20, 5]);
  const panned = project(pan(camera, kScreen, 13, -7), kScreen, [10, 20, 5]);
  near(panned.x, before.x + 13);
  near(panned.y, before.y - 7);
  const zoomed = project(zoom(camera, kScreen, 0.25, before), kScreen, [10, 20, 5]);
  near(zoomed.x, before.x);
  near(zoomed.y, before.y);
});

test('a press finds the nearest move within reach', () => {
  const polyline = new Polyline();
  for (const [x, y, move] of [[0, 0, 0], [100, 0, 1], [100, 50, 1], [0, 50, 0]] as const) polyline.add(x, y, 0, move, 1, 0);
  const camera = fit(viewFrom(kFirstCamera, 'top'), kScreen, polyline.bounds()!);
  const press = (x: number, y: number, showsRapids = true) => pick(camera, kScreen, polyline, project(camera, kScreen, [x, y, 0]), 10, showsRapids);
  assert.equal(press(50, 0), 1);
  assert.equal(press(99.5, 25), 2);
  assert.equal(press(50, 50), 3);
  assert.equal(press(50, 50, false), -1);
  assert.equal(press(50, 25), -1);
});
