/** The plots by keyboard. */
import type { View } from './view';

export const keysText =
  'Left and right arrow move the cursor, with shift ten steps; page up and down move the picture; plus and minus zoom; ' +
  'home and end go to the ends; 0 or escape shows the whole run; a and b put two cursors down, whose differences are reported, ' +
  'and c takes them away. Buttons among the plots hide traces and zoom into their values.';

const quiet_ms = 300;

/** `neighbour(by)`: the time that many steps from the cursor. `speak` is called when the keys have come to rest. */
export function bindKeys(area: HTMLElement, view: View, neighbour: (by: number) => number, speak: () => void): void {
  const put = (name: 'a' | 'b'): void => view.putMarks({ [name]: neighbour(0) });
  let timer = 0;
  const acts: Record<string, (steps: number) => void> = {
    ArrowLeft: (steps) => view.putCursor(neighbour(-steps), true),
    ArrowRight: (steps) => view.putCursor(neighbour(steps), true),
    Home: () => view.putCursor(view.first, true),
    End: () => view.putCursor(view.last, true),
    PageUp: () => view.moveBy(-0.5),
    PageDown: () => view.moveBy(0.5),
    '+': () => view.zoomBy(0.5),
    '=': () => view.zoomBy(0.5),
    '-': () => view.zoomBy(2),
    '0': () => view.reset(),
    Escape: () => view.reset(),
    a: () => put('a'),
    b: () => put('b'),
    c: () => view.clearMarks(),
  };
  area.addEventListener('keydown', (event) => {
    const act = acts[event.key];
    if (!act || event.ctrlKey || event.metaKey || event.altKey) return;
    // The buttons among the plots keep their own keys.
    event.preventDefault();
    act(event.shiftKey && event.key.startsWith('Arrow') ? 10 : 1);
    clearTimeout(timer);
    timer = window.setTimeout(speak, quiet_ms);
  });
}
