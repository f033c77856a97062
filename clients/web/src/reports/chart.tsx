// One series with its limits, drawn by uPlot in the colors of the page.
import { useEffect, useRef } from 'preact/hooks';
import uPlot from 'uplot';
import { numberText } from '../texts/texts';
import type { Limits, Series } from './series';

const kHeight = 280;

function color(name: string): string {
  return getComputedStyle(document.documentElement).getPropertyValue(name).trim();
}

function optionsOf(series: Series, width: number): uPlot.Options {
  // Of a wide axis the first digits would be cut off.
  const axis = { stroke: color('--text'), grid: { stroke: color('--line') }, ticks: { stroke: color('--line') } };
  const limit = (label: string) => ({ label, stroke: color('--alarm'), dash: [8, 6], width: 2, points: { show: false } });
  return {
    width, height: kHeight, legend: { show: false }, scales: { x: { time: false } }, cursor: { drag: { x: true, y: false } },
    axes: [axis, { ...axis, size: 90, values: (_, ticks) => ticks.map((tick) => numberText(tick, 4)) }],
    series: [{}, { label: series.name, stroke: color('--accent'), width: 2, points: { show: series.values.length < 300 } }, limit('lower'), limit('upper')],
  };
}

export function Chart({ series, limits, label }: { series: Series; limits: Limits; label: string }) {
  const frame = useRef<HTMLDivElement>(null);
  useEffect(() => {
    const place = frame.current!;
    const flat = (value: number | null) => series.values.map(() => value);
    const data: uPlot.AlignedData = [series.values.map((_, i) => i + 1), series.values, flat(limits.lower), flat(limits.upper)];
    let chart = new uPlot(optionsOf(series, place.clientWidth), data, place);
    const draw = () => {
      chart.destroy();
      chart = new uPlot(optionsOf(series, place.clientWidth), data, place);
    };
    const dark = matchMedia('(prefers-color-scheme: dark)');
    const size = new ResizeObserver(() => { if (chart.width !== place.clientWidth) chart.setSize({ width: place.clientWidth, height: kHeight }); });
    dark.addEventListener('change', draw);
    size.observe(place);
    return () => {
      dark.removeEventListener('change', draw);
      size.disconnect();
      chart.destroy();
    };
  }, [series, limits.lower, limits.upper]);
  return <div ref={frame} class="chart" role="img" aria-label={label} />;
}
