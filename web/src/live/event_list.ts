/** What happened, newest first. */
import { clock, type SiteEvent } from './api';
import { element } from './element';

export class EventList {
  readonly place = element('ul', 'events');
  private shown = '';

  constructor(private readonly most: number) {}

  show(events: readonly SiteEvent[]): void {
    const lines = events.slice(0, this.most);
    const all = lines.map((event) => `${event.id} ${event.time} ${event.text}`).join('\n');
    if (this.shown === all && this.place.children.length > 0) return;
    this.shown = all;
    this.place.replaceChildren(...lines.map((event) => element('li', '', element('time', '', clock(event.time)), ' ',
      element('b', '', event.valve), event.valve === '' ? '' : ' ', event.text)));
    if (lines.length === 0) this.place.append(element('li', 'soft', 'none yet'));
  }
}
