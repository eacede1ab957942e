/** What may be done with an alarm beside acknowledging it: shelving it for a time, and commenting. */
import type { Alarm } from './api';
import { element } from './element';
import { visitor } from './visitor';

const times: [string, number][] = [['1 hour', 1], ['8 hours', 8], ['1 day', 24], ['1 week', 168]];

export class AlarmDesk {
  readonly place = element('details', 'desk');
  private readonly shelf = element('form', '');
  private readonly time = element('select', '');
  private readonly shelve = element('button', '', 'Shelve');
  private readonly back = element('button', '', 'Take off the shelf');
  private readonly text = element('input', '');
  private readonly comment = element('form', '');

  constructor(alarm: Alarm, order: (what: string, body?: unknown) => Promise<void>) {
    for (const [text, hours] of times) this.time.add(new Option(text, String(hours)));
    this.time.value = '8';
    this.shelve.type = 'submit';
    this.back.type = 'button';
    this.text.maxLength = 250;
    this.text.required = true;
    const send = element('button', '', 'Comment');
    send.type = 'submit';
    this.shelf.append(element('label', '', 'For ', this.time), ' ', this.shelve, this.back);
    this.comment.append(element('label', '', 'Comment ', this.text), ' ', send);
    this.shelf.addEventListener('submit', (event) => {
      event.preventDefault();
      void order('shelve', { hours: Number(this.time.value) });
    });
    this.back.addEventListener('click', () => void order('unshelve'));
    this.comment.addEventListener('submit', (event) => {
      event.preventDefault();
      void order('comment', { text: this.text.value }).then(() => { this.text.value = ''; });
    });
    const head = element('summary', '', 'shelve or comment');
    head.setAttribute('aria-label', `Shelve or comment alarm ${alarm.id}`);
    this.place.append(head, this.shelf, this.comment);
  }

  show(alarm: Alarm): void {
    this.place.hidden = visitor.session.role !== 'acknowledge' || alarm.comments === undefined;
    const shelved = alarm.state === 'shelved';
    this.back.hidden = !shelved;
    this.shelve.hidden = (this.time.parentElement as HTMLElement).hidden = shelved;
    this.shelf.hidden = alarm.state === 'cleared';
  }
}
