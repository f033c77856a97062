// The path on the screen, and what mouse, fingers and keys do to it.
import { useEffect, useRef, useState } from 'preact/hooks';
import { texts } from '../texts/texts';
import { fit, kFirstCamera, orbit, pan, pick, project, viewFrom, zoom, type Camera, type Screen, type Vector, type ViewName } from './camera';
import { kMoves, type Polyline } from './polyline';
import { cameraOfAxes, kAxes, Renderer, type Color, type Colors } from './renderer';

const kClick = 5; // px: a shorter drag is a click
const kReach = 14; // px
const kKeyStep = 40; // px
const kKeyZoom = 1.25;
const kQuietMs = 200;
/// How near to the ground the color of a move is that is still to come.
const kPale = 0.62;

interface Props {
  polyline: Polyline;
  /// Another number: there are more points.
  version: number;
  isComplete: boolean;
  isLathe: boolean;
  selection: Array<{ first: number; last: number }>;
  showsRapids: boolean;
  label: string;
  /// The last point that a machine has come to, and where its tool is; absent: no machine executes it.
  executed?: { point: number; tool: Vector };
  /// A panel among others: no hints below.
  isSmall?: boolean;
  onPick: (point: number) => void;
  onNext: (step: 1 | -1) => void;
}

function colorOf(name: string): Color {
  const text = getComputedStyle(document.documentElement).getPropertyValue(name).trim();
  return [1, 3, 5].map((i) => parseInt(text.slice(i, i + 2), 16) / 255) as Color;
}

function colors(): Colors {
  const moves = kMoves.map((move) => colorOf(`--path-${move}`));
  const ground = colorOf('--raised');
  return {
    moves, pending: moves.map((color) => color.map((part, i) => part + (ground[i]! - part) * kPale) as Color), selected: colorOf('--path-selected'),
    axes: [colorOf('--path-first-axis'), colorOf('--path-second-axis'), colorOf('--path-third-axis')],
  };
}

export function PathCanvas(props: Props) {
  const t = texts().path;
  const canvas = useRef<HTMLCanvasElement>(null);
  const frame = useRef<HTMLDivElement>(null);
  const labels = useRef<Array<HTMLSpanElement | null>>([]);
  const tool = useRef<HTMLSpanElement>(null);
  const renderer = useRef<Renderer | null>(null);
  const camera = useRef<Camera>(kFirstCamera);
  const latest = useRef(props);
  latest.current = props;
  const asked = useRef({ isDrawing: false, isQuick: false, hasFitted: false, isTouched: false, quiet: 0 });
  const [hasGraphics, setGraphics] = useState(true);

  const screen = (): Screen => ({ width: frame.current?.clientWidth || 1, height: frame.current?.clientHeight || 1 });

  const placeLabels = () => {
    const names = latest.current.isLathe ? ['Z', 'X', 'Y'] : ['X', 'Y', 'Z'];
    const { width, height } = screen();
    const past = kAxes.length + 10;
    for (const [i, label] of labels.current.entries()) {
      if (!label) continue;
      const end: [number, number, number] = [0, 0, 0];
      end[i] = past;
      const middle = project(cameraOfAxes(camera.current, screen()), screen(), end);
      const [x, y] = [middle.x - width / 2 + kAxes.corner, middle.y + height / 2 - kAxes.corner];
      label.textContent = names[i]!;
      label.style.transform = `translate(${x.toFixed(1)}px, ${y.toFixed(1)}px) translate(-50%, -50%)`;
    }
  };
  const placeTool = () => {
    const at = latest.current.executed?.tool;
    if (!at || !tool.current) return;
    const { x, y } = project(camera.current, screen(), at);
    tool.current.style.transform = `translate(${x.toFixed(1)}px, ${y.toFixed(1)}px)`;
  };
  const draw = (isQuick = false) => {
    asked.current.isQuick = isQuick;
    if (asked.current.isDrawing) return;
    asked.current.isDrawing = true;
    requestAnimationFrame(() => {
      asked.current.isDrawing = false;
      const { polyline, selection, showsRapids, executed } = latest.current;
      renderer.current?.draw(polyline, screen(), {
        camera: camera.current, colors: colors(), showsRapids, selection, executed: executed?.point ?? null, isQuick: asked.current.isQuick,
      });
      placeLabels();
      placeTool();
    });
  };
  /// All points follow when nothing has moved for a moment.
  const drawQuickly = () => {
    draw(true);
    clearTimeout(asked.current.quiet);
    asked.current.quiet = window.setTimeout(() => draw(), kQuietMs);
  };
  const show = (next: Camera) => {
    camera.current = next;
    asked.current.isTouched = true;
    drawQuickly();
  };
  const fitAll = () => {
    const bounds = latest.current.polyline.bounds();
    if (bounds) show(fit(camera.current, screen(), bounds));
  };
  const look = (view: ViewName) => {
    camera.current = viewFrom(camera.current, view);
    fitAll();
  };

  useEffect(() => {
    const element = canvas.current!;
    const begin = () => {
      const gl = element.getContext('webgl2', { antialias: true, alpha: true });
      setGraphics(gl !== null);
      renderer.current = gl && new Renderer(gl);
    };
    const lose = (event: Event) => { event.preventDefault(); renderer.current = null; };
    const restore = () => { begin(); draw(); };
    begin();
    element.addEventListener('webglcontextlost', lose);
    element.addEventListener('webglcontextrestored', restore);
    const resize = new ResizeObserver(() => {
      const { width, height } = screen();
      element.width = Math.round(width * devicePixelRatio);
      element.height = Math.round(height * devicePixelRatio);
      if (!asked.current.isTouched) fitQuietly();
      draw();
    });
    resize.observe(frame.current!);
    const theme = matchMedia('(prefers-color-scheme: dark)');
    const redraw = () => draw();
    theme.addEventListener('change', redraw);
    const attribute = new MutationObserver(redraw);
    attribute.observe(document.documentElement, { attributes: true, attributeFilter: ['data-theme'] });
    return () => {
      resize.disconnect();
      attribute.disconnect();
      theme.removeEventListener('change', redraw);
      element.removeEventListener('webglcontextlost', lose);
      element.removeEventListener('webglcontextrestored', restore);
      clearTimeout(asked.current.quiet);
      renderer.current = null;
    };
  }, []);

  /// Until the user has looked elsewhere, all of what is there is shown.
  const fitQuietly = () => {
    const bounds = latest.current.polyline.bounds();
    if (!bounds) return;
    if (!asked.current.hasFitted && latest.current.isLathe) camera.current = viewFrom(camera.current, 'top');
    asked.current.hasFitted = true;
    camera.current = fit(camera.current, screen(), bounds);
  };
  useEffect(() => {
    asked.current.isTouched = false;
    asked.current.hasFitted = false;
  }, [props.polyline]);
  useEffect(() => {
    if (!asked.current.isTouched) fitQuietly();
    drawQuickly();
  }, [props.version, props.isComplete, props.polyline, props.selection, props.showsRapids]);

  useEffect(() => draw(), [props.executed?.point, ...(props.executed?.tool ?? [])]);

  const pointers = useRef(new Map<number, { x: number; y: number }>());
  const dragged = useRef(0);
  const place = (event: PointerEvent | WheelEvent) => {
    const box = frame.current!.getBoundingClientRect();
    return { x: event.clientX - box.left, y: event.clientY - box.top };
  };
  const down = (event: PointerEvent) => {
    canvas.current!.setPointerCapture(event.pointerId);
    if (pointers.current.size === 0) dragged.current = 0;
    pointers.current.set(event.pointerId, place(event));
  };
  const move = (event: PointerEvent) => {
    const before = pointers.current.get(event.pointerId);
    if (!before) return;
    const now = place(event);
    const [dx, dy] = [now.x - before.x, now.y - before.y];
    dragged.current += Math.abs(dx) + Math.abs(dy);
    pointers.current.set(event.pointerId, now);
    if (dragged.current < kClick) return;
    const others = [...pointers.current].filter(([id]) => id !== event.pointerId).map(([, at]) => at);
    if (others.length === 0) {
      const isPan = event.buttons !== 1 || event.shiftKey;
      show((isPan ? pan : orbit)(camera.current, screen(), dx, dy));
      return;
    }
    // Two fingers: the middle is dragged, the distance zooms.
    const other = others[0]!;
    const [was, is] = [Math.hypot(before.x - other.x, before.y - other.y), Math.hypot(now.x - other.x, now.y - other.y)];
    const middle = { x: (now.x + other.x) / 2, y: (now.y + other.y) / 2 };
    show(zoom(pan(camera.current, screen(), dx / 2, dy / 2), screen(), was / Math.max(1, is), middle));
  };
  const up = (event: PointerEvent) => {
    if (!pointers.current.delete(event.pointerId) || dragged.current >= kClick || event.type === 'pointercancel') return;
    const reach = event.pointerType === 'touch' ? 2 * kReach : kReach;
    const point = pick(camera.current, screen(), latest.current.polyline, place(event), reach, latest.current.showsRapids);
    if (point >= 0) latest.current.onPick(point);
  };
  const wheel = (event: WheelEvent) => {
    event.preventDefault();
    show(zoom(camera.current, screen(), Math.exp(Math.sign(event.deltaY) * Math.min(Math.abs(event.deltaY), 100) / 400), place(event)));
  };
  const keys: Record<string, () => void> = {
    '+': () => show(zoom(camera.current, screen(), 1 / kKeyZoom)), '-': () => show(zoom(camera.current, screen(), kKeyZoom)),
    '0': fitAll, '1': () => look('top'), '2': () => look('front'), '3': () => look('right'), '4': () => look('oblique'),
    n: () => props.onNext(1), p: () => props.onNext(-1),
  };
  const arrows: Record<string, [number, number]> = { ArrowLeft: [-kKeyStep, 0], ArrowRight: [kKeyStep, 0], ArrowUp: [0, -kKeyStep], ArrowDown: [0, kKeyStep] };
  const key = (event: KeyboardEvent) => {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const arrow = arrows[event.key];
    if (arrow) show((event.shiftKey ? pan : orbit)(camera.current, screen(), ...arrow));
    else if (Object.hasOwn(keys, event.key)) keys[event.key]!();
    else return;
    event.preventDefault();
  };
  useEffect(() => {
    const element = canvas.current!;
    element.addEventListener('wheel', wheel, { passive: false });
    return () => element.removeEventListener('wheel', wheel);
  });
  return (
    <>
      <div class="path-tools" role="group" aria-label={t.view}>
        {(['top', 'front', 'right', 'oblique'] as const).map((view) => <button key={view} type="button" onClick={() => look(view)}>{t.views[view]}</button>)}
        <button type="button" onClick={fitAll}>{t.fit}</button>
        <button type="button" aria-label={t.nearer} onClick={() => show(zoom(camera.current, screen(), 1 / kKeyZoom))}>+</button>
        <button type="button" aria-label={t.farther} onClick={() => show(zoom(camera.current, screen(), kKeyZoom))}>−</button>
      </div>
      {!hasGraphics && <p class="notice warn">{t.noGraphics}</p>}
      <div class={`path-frame ${props.isSmall ? 'small' : ''}`} ref={frame}>
        <canvas ref={canvas} tabIndex={0} role="application" aria-label={props.label} aria-describedby="path-keys" onKeyDown={key} onPointerDown={down} onPointerMove={move}
          onPointerUp={up} onPointerCancel={up} onContextMenu={(event) => event.preventDefault()} />
        {[0, 1, 2].map((i) => <span key={i} class={`axis-label axis-${i}`} aria-hidden="true" ref={(label) => { labels.current[i] = label; }} />)}
        {props.executed && <span class="tool-mark" aria-hidden="true" ref={tool} />}
      </div>
      <p id="path-keys" class={props.isSmall ? 'visually-hidden' : 'hint'}>{t.keys}</p>
    </>
  );
}
