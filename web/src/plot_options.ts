/** What all plots of a page have in common: axes in the page's colours, zoom by dragging, one cursor. */
import type uPlot from 'uplot';
import { colour } from './colours';
import { numberText } from './number_text';
import type { View } from './view';

export const yAxisWidth = 52;
export const rightMargin = 12;
const font = '12px system-ui, -apple-system, "Segoe UI", Roboto, sans-serif';
const xAxisHeight = 46;

/** Steps are 1, 2, 2.5 or 5 times a power of ten. */
function decimalsOf(step: number): number {
  for (let decimals = 0; decimals < 9; ++decimals) {
    const shifted = step * 10 ** decimals;
    if (Math.abs(shifted - Math.round(shifted)) < 1e-6 * shifted) return decimals;
  }
  return 9;
}

export function tickTexts(splits: number[], step: number): string[] {
  return splits.map((value) => numberText(value, decimalsOf(step)));
}

/** `last`: the plot at the bottom, which names the time. */
export function xAxis(last: boolean): uPlot.Axis {
  const line = { stroke: () => colour('rule'), width: 1 };
  if (!last) return { grid: line, ticks: { show: false }, size: 4, values: (_plot, splits) => splits.map(() => '') };
  return {
    grid: line,
    ticks: { ...line, size: 4 },
    stroke: () => colour('soft'),
    font,
    labelFont: font,
    label: 'Time [s]',
    labelSize: 20,
    size: xAxisHeight - 20,
    gap: 4,
    space: 80,
    values: (_plot, splits, _axis, _space, step) => tickTexts(splits, step),
  };
}

export function xAxisHeightOf(last: boolean): number {
  return last ? xAxisHeight : 4;
}

export function yAxis(): uPlot.Axis {
  const line = { stroke: () => colour('rule'), width: 1 };
  return {
    grid: line,
    ticks: { show: false },
    stroke: () => colour('soft'),
    font,
    size: yAxisWidth,
    gap: 6,
    space: 34,
    values: (_plot, splits, _axis, _space, step) => tickTexts(splits, step),
  };
}

export function cursorOf(view: View): uPlot.Cursor {
  return {
    y: false,
    points: { show: false },
    drag: { x: true, y: false, setScale: false, dist: 4 },
    bind: {
      dblclick: () => () => {
        view.reset();
        return null;
      },
    },
  };
}

/** Zoom by dragging, and the cursor that all plots share. */
export function hooksOf(view: View): Partial<uPlot.Hooks.Arrays> {
  return {
    setSelect: [
      (plot) => {
        const { left, width } = plot.select;
        if (width <= 0) return;
        view.zoomTo(plot.posToVal(left, 'x'), plot.posToVal(left + width, 'x'));
        plot.setSelect({ left: 0, top: 0, width: 0, height: 0 }, false);
      },
    ],
    setCursor: [
      (plot) => {
        const left = plot.cursor.left ?? -1;
        view.putCursor(left < 0 ? null : plot.posToVal(left, 'x'));
      },
    ],
  };
}

/** Puts the plot's cursor where the view's is, without telling the view again. */
export function showCursor(plot: uPlot, view: View): void {
  const time = view.cursor;
  const inside = time !== null && time >= view.from && time <= view.to;
  plot.setCursor(inside ? { left: plot.valToPos(time, 'x'), top: 0 } : { left: -10, top: -10 }, false);
}
