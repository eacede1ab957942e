/** The plots of a run as one picture, with their titles and the names of the traces that are on. */
import { colour, paleColour } from './colours';
import type { Series } from './run_data';

export interface PicturePart {
  title: string;
  series: Series[];
  canvas: HTMLCanvasElement;
}

const margin = 16;
const headHeight = 34;
const titleHeight = 24;
const font = (size: number, weight = 400): string => `${weight} ${size}px system-ui, -apple-system, "Segoe UI", Roboto, sans-serif`;

function drawNames(ctx: CanvasRenderingContext2D, part: PicturePart, y: number, right: number): void {
  ctx.font = font(12.5, 600);
  ctx.fillStyle = colour('ink');
  ctx.fillText(part.title, margin + 52, y);
  let x = margin + 52 + ctx.measureText(part.title).width + 16;
  ctx.font = font(12.5);
  for (const series of part.series) {
    const wide = 26 + ctx.measureText(series.name).width;
    if (x + wide > right) return;
    ctx.fillStyle = series.shape === 'line' ? colour(series.tone) : paleColour(series.tone, 0.4);
    if (series.shape === 'line') ctx.fillRect(x, y - 5, 18, 2);
    else ctx.fillRect(x, y - 9, 18, 10);
    ctx.fillStyle = colour('soft');
    ctx.fillText(series.name, x + 24, y);
    x += wide + 14;
  }
}

/** `heading` stands above all of it. */
export function pictureOf(heading: string, parts: PicturePart[]): HTMLCanvasElement {
  const ratio = devicePixelRatio;
  const widest = Math.max(1, ...parts.map(({ canvas }) => canvas.width / ratio));
  const width = widest + 2 * margin;
  const height = parts.reduce((sum, { canvas }) => sum + titleHeight + canvas.height / ratio, headHeight + margin);
  const out = document.createElement('canvas');
  out.width = Math.round(width * ratio);
  out.height = Math.round(height * ratio);
  const ctx = out.getContext('2d') as CanvasRenderingContext2D;
  ctx.scale(ratio, ratio);
  ctx.fillStyle = colour('paper');
  ctx.fillRect(0, 0, width, height);
  ctx.font = font(14, 600);
  ctx.fillStyle = colour('ink');
  ctx.fillText(heading, margin, 24);
  let top = headHeight;
  for (const part of parts) {
    drawNames(ctx, part, top + 15, width - margin);
    top += titleHeight;
    ctx.drawImage(part.canvas, margin, top, part.canvas.width / ratio, part.canvas.height / ratio);
    top += part.canvas.height / ratio;
  }
  return out;
}
