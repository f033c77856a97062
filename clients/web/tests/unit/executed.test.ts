// Where on its path a machine is: in loops, in arcs, in runs that began in the middle, on paths that were made coarser.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { ExecutedCursor } from '../../src/path/executed';
import { Polyline } from '../../src/path/polyline';

/// Line 2 moves along X and line 3 along Y, in so many passes; a mark after every tenth pass, two blocks each.
function loop(passes: number, maxPoints?: number): Polyline {
  const polyline = new Polyline(maxPoints);
  polyline.add(0, 0, 0, 0, 1, 0);
  for (let pass = 0; pass < passes; ++pass) {
    polyline.add(pass + 1, pass, 0, 1, 2, 10);
    polyline.add(pass + 1, pass + 1, 0, 1, 3, 20);
    if (pass % 10 === 9) polyline.mark(2 * (pass + 1));
  }
  polyline.mark(2 * passes);
  return polyline;
}

test('the pass of a loop is the one of the executed blocks', () => {
  const cursor = new ExecutedCursor(loop(100));
  for (const pass of [0, 7, 42, 99, 13]) {
    const point = cursor.at({ executed: 2 * pass, line: 2, tool: [pass + 0.5, pass, 0] });
    assert.equal(point, 2 * pass, `pass ${pass}`);
  }
});

test('in an arc the tool decides, which chords are past', () => {
  const polyline = new Polyline();
  polyline.add(10, 0, 0, 0, 1, 0);
  for (let i = 1; i <= 8; ++i) polyline.add(10 * Math.cos(i * Math.PI / 8), 10 * Math.sin(i * Math.PI / 8), 0, 2, 5, 40);
  polyline.mark(5);
  const cursor = new ExecutedCursor(polyline);
  assert.equal(cursor.at({ executed: 4, line: 5, tool: [1, 9.9, 0] }), 3);
  assert.equal(cursor.at({ executed: 4, line: 5, tool: [-9.9, 1, 0] }), 7);
  assert.equal(cursor.at({ executed: 4, line: 5, tool: null }), 0);
});

test('a run that began in the middle is found by its lines', () => {
  const polyline = new Polyline();
  for (let line = 1; line <= 10_000; ++line) {
    polyline.add(line, 0, 0, 1, line, line);
    if (line % 100 === 0) polyline.mark(line);
  }
  const cursor = new ExecutedCursor(polyline);
  assert.equal(cursor.at({ executed: 3, line: 9000, tool: [8999.5, 0, 0] }), 8998);
});

test('a block that moves nothing leaves the machine where it is', () => {
  const polyline = new Polyline();
  polyline.add(0, 0, 0, 0, 1, 0);
  polyline.add(5, 0, 0, 1, 2, 0);
  polyline.add(5, 5, 0, 1, 4, 0);
  polyline.mark(4);
  assert.equal(new ExecutedCursor(polyline).at({ executed: 2, line: 3, tool: [5, 0, 0] }), 0);
});

test('the marks follow the points when a path is made coarser', () => {
  const polyline = new Polyline(512);
  for (let i = 0; i < 50_000; ++i) {
    polyline.add(i / 100, Math.sin(i / 500), 0, 1, i + 1, i);
    if (i % 2048 === 2047) polyline.mark(i + 1);
  }
  assert.ok(polyline.length <= 512 && polyline.tolerance > 0);
  for (const { blocks, point } of polyline.marks) {
    assert.ok(point < polyline.length);
    assert.ok(polyline.lines[point]! <= blocks, `${polyline.lines[point]} ${blocks}`);
    if (point + 1 < polyline.length) assert.ok(polyline.lines[point + 1]! >= blocks - 1, `${polyline.lines[point + 1]} ${blocks}`);
  }
  const at = 30_000;
  const point = new ExecutedCursor(polyline).at({ executed: at, line: at, tool: [at / 100, Math.sin(at / 500), 0] });
  assert.ok(polyline.lines[point]! <= at && polyline.lines[point + 1]! >= at, `${polyline.lines[point]}`);
});

test('nothing is executed of a path that is not there yet', () => {
  assert.equal(new ExecutedCursor(new Polyline()).at({ executed: 9, line: 3, tool: [0, 0, 0] }), 0);
});
