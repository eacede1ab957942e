/** What all plots of a page have in common: axes in the page's colours, zoom by dragging, one cursor. */
import type uPlot from 'uplot';
import { colour } from './colours';
import { numberText } from './number_text';
import type { View } from './view';

export const yAxisWidth = 52;
export const rightMargin = 12;
const font = '12px system-ui, -apple-system, "Segoe UI", Roboto, sans-serif';
const xAxisHeight = 46;
/** Between two marks of time, the same in all plots: their grid lines stand above each other. */
const timeSpace = 80;

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

/** An axis across that is not the time. */
export function valueAxis(label: () => string): uPlot.Axis {
  return { ...xAxis(true), label };
}

/** `last`: the plot at the bottom, which names the time. */
export function xAxis(last: boolean): uPlot.Axis {
  const line = { stroke: () => colour('rule'), width: 1 };
  if (!last) return { grid: line, ticks: { show: false }, size: 4, space: timeSpace, values: (_plot, splits) => splits.map(() => '') };
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
    space: timeSpace,
    values: (_plot, splits, _axis, _space, step) => tickTexts(splits, step),
  };
}

export function xAxisHeightOf(last: boolean): number {
  return last ? xAxisHeight : 4;
}

/** `height`: of the plot; a low one has its marks closer together, since one alone shows no scale. */
export function yAxis(height: number): uPlot.Axis {
  const line = { stroke: () => colour('rule'), width: 1 };
  return {
    grid: line,
    ticks: { show: false },
    stroke: () => colour('soft'),
    font,
    size: yAxisWidth,
    gap: 6,
    space: height < 120 ? 17 : 34,
    values: (_plot, splits, _axis, _space, step) => tickTexts(splits, step),
  };
}

/** Drags shorter than this in a direction do not zoom in it. */
const aslant_px = 30;

/** `heights`: whether dragging up or down zooms too. */
export function cursorOf(view: View, heights = false): uPlot.Cursor {
  return {
    y: false,
    points: { show: false },
    drag: { x: true, y: heights, setScale: false, dist: 4, ...(heights ? { uni: aslant_px } : {}) },
    bind: {
      dblclick: () => () => {
        view.undoClick();
        view.reset();
        return null;
      },
    },
  };
}

/** A cursor that stays: a line, and its letter where there is one. */
function drawMark(plot: uPlot, time: number, letter: string): void {
  const { ctx, bbox } = plot;
  const x = plot.valToPos(time, 'x', true);
  if (x < bbox.left || x > bbox.left + bbox.width) return;
  ctx.save();
  ctx.strokeStyle = colour('ink');
  ctx.lineWidth = devicePixelRatio;
  ctx.setLineDash([4 * devicePixelRatio, 3 * devicePixelRatio]);
  ctx.beginPath();
  ctx.moveTo(x, bbox.top);
  ctx.lineTo(x, bbox.top + bbox.height);
  ctx.stroke();
  ctx.font = `600 ${11 * devicePixelRatio}px system-ui, sans-serif`;
  ctx.fillStyle = colour('ink');
  const atRight = x > bbox.left + bbox.width - 14 * devicePixelRatio;
  ctx.textAlign = atRight ? 'right' : 'left';
  ctx.setLineDash([]);
  ctx.lineJoin = 'round';
  ctx.lineWidth = 3 * devicePixelRatio;
  ctx.strokeStyle = colour('paper');
  const left = x + (atRight ? -3 : 3) * devicePixelRatio;
  const top = bbox.top + 11 * devicePixelRatio;
  ctx.strokeText(letter, left, top);
  ctx.fillText(letter, left, top);
  ctx.restore();
}

export function drawMarks(plot: uPlot, view: View, letters = true): void {
  if (view.marks.a !== null) drawMark(plot, view.marks.a, letters ? 'A' : '');
  if (view.marks.b !== null) drawMark(plot, view.marks.b, letters ? 'B' : '');
}

/** Clicks put the cursors that stay. `snapped`: the time of the sample there. */
export function bindClicks(plot: uPlot, view: View, snapped: (time: number) => number): void {
  plot.over.addEventListener('click', (event) => {
    if (event.detail === 1) view.clickAt(snapped(plot.posToVal(event.offsetX, 'x')));
  });
}

/** Zoom by dragging, and the cursor that all plots share. `zoomHeight` gets the range of values that was dragged over. */
export function hooksOf(view: View, zoomHeight?: (lowest: number, highest: number) => void): Partial<uPlot.Hooks.Arrays> {
  return {
    setSelect: [
      (plot) => {
        const { left, top, width, height } = plot.select;
        if (width <= 0 || height <= 0) return;
        const upright = zoomHeight !== undefined && height < plot.over.clientHeight - 1;
        const [from, to] = [plot.posToVal(left, 'x'), plot.posToVal(left + width, 'x')];
        if (upright) zoomHeight(plot.posToVal(top + height, 'y'), plot.posToVal(top, 'y'));
        plot.setSelect({ left: 0, top: 0, width: 0, height: 0 }, false);
        if (width < plot.over.clientWidth - 1 || !upright) view.zoomTo(from, to);
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

/** Puts the plot's cursor where the view's is, without a call of the view. */
export function showCursor(plot: uPlot, view: View): void {
  const time = view.cursor;
  const inside = time !== null && time >= view.from && time <= view.to;
  plot.setCursor(inside ? { left: plot.valToPos(time, 'x'), top: 0 } : { left: -10, top: -10 }, false);
}
