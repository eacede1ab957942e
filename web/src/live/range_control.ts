/** Which time the plots of a valve show, and which valve beside it: chosen by fields and kept in the address. */
import { clock } from './api';
import { element, setText } from './element';

const spans: [string, number][] = [['1 hour', 3600], ['1 day', 86400], ['1 week', 7 * 86400], ['30 days', 30 * 86400]];
const own = 'own', nobody = '';

/** Seconds since 1970; `moves`: its end is now, whenever that is. */
export interface Asked {
  from: number;
  to: number;
  moves: boolean;
  beside: string | null;
}

/** What stands behind the question mark of "#/valve/press_1?span=3600&with=press_2". */
function fromAddress(): URLSearchParams {
  const at = location.hash.indexOf('?');
  return new URLSearchParams(at < 0 ? '' : location.hash.slice(at + 1));
}

/** As fields of that kind have it, by the reader's clock. */
const fieldText = (seconds: number): string => clock(seconds * 1000).replace(' ', 'T');

function timeField(name: string): HTMLInputElement {
  const out = element('input', '');
  out.type = 'datetime-local';
  out.step = '1';
  out.name = name;
  return out;
}

export class RangeControl {
  readonly place = element('div', 'tools');
  private readonly span = element('select', '');
  private readonly from = timeField('from');
  private readonly to = timeField('to');
  private readonly other = element('select', '');
  private readonly otherLabel = element('label', '', 'Beside it ', this.other);
  private readonly trouble = element('span', 'stale');
  /** Whether the span is the reader's, or may be one that fits. */
  chosen: boolean;

  constructor(private readonly id: string, private readonly changed: () => void) {
    for (const [text, seconds] of spans) this.span.add(new Option(text, String(seconds)));
    this.span.add(new Option('from … to …', own));
    this.other.add(new Option('none', nobody));
    const address = fromAddress(), span = address.get('span') ?? '';
    const from = Date.parse(address.get('from') ?? '') / 1000, to = Date.parse(address.get('to') ?? '') / 1000;
    const absolute = from < to;  // NaN: not given
    this.span.value = absolute ? own : spans.some(([, seconds]) => String(seconds) === span) ? span : '86400';
    this.chosen = absolute || span !== '';
    if (absolute) [this.from.value, this.to.value] = [fieldText(from), fieldText(to)];
    const beside = address.get('with');
    if (beside !== null && beside !== id) this.offer([beside]);
    if (beside !== null) this.other.value = beside;
    this.otherLabel.hidden = this.other.length < 2;
    this.span.addEventListener('change', () => this.choose());
    this.other.addEventListener('change', () => this.choose());
    for (const field of [this.from, this.to]) {
      field.addEventListener('change', () => {
        this.span.value = own;
        this.choose();
      });
    }
    this.place.append(element('label', '', 'Span ', this.span), element('label', '', 'From ', this.from),
                      element('label', '', 'to ', this.to), this.otherLabel, this.trouble);
    this.trouble.setAttribute('role', 'status');
  }

  /** Valves that may be shown beside. */
  offer(ids: readonly string[]): void {
    const known = new Set([...this.other.options].map((one) => one.value));
    for (const id of ids) if (id !== this.id && !known.has(id)) this.other.add(new Option(id, id));
    this.otherLabel.hidden = this.other.length < 2;
  }

  /** Null where the fields hold no time. */
  asked(): Asked | null {
    const beside = this.other.value === nobody ? null : this.other.value;
    if (this.span.value !== own) {
      const to = Date.now() / 1000;
      return { from: to - Number(this.span.value), to, moves: true, beside };
    }
    const from = new Date(this.from.value).getTime() / 1000, to = new Date(this.to.value).getTime() / 1000;
    return from < to ? { from, to, moves: false, beside } : null;
  }

  /** A shorter span fits better: the store has just begun. */
  shorten(): void {
    this.span.value = '3600';
  }

  /** What is shown stands in the fields, where nobody writes in them. */
  show({ from, to, moves }: Asked): void {
    for (const [field, seconds] of [[this.from, from], [this.to, to]] as const) {
      if (moves && document.activeElement !== field) field.value = fieldText(Math.round(seconds));
    }
  }

  private choose(): void {
    this.chosen = true;
    const asked = this.asked();
    setText(this.trouble, asked === null ? 'The begin must lie before the end.' : '');
    if (asked === null) return;
    const address = new URLSearchParams();
    const iso = (seconds: number): string => new Date(seconds * 1000).toISOString().replace('.000', '');
    if (asked.moves) address.set('span', this.span.value);
    else for (const [key, seconds] of [['from', asked.from], ['to', asked.to]] as const) address.set(key, iso(seconds));
    if (asked.beside !== null) address.set('with', asked.beside);
    history.replaceState(null, '', `${location.hash.replace(/\?.*/, '')}?${address.toString()}`);
    this.changed();
  }
}
