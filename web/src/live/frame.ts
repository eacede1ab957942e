/** What the pages of a site and of a fleet share: they ask the program again and again, show one view of its answer, say
 *  how old that is, and let nobody read who may not. */
import { readSession, Refusal } from './api';
import { element, setText } from './element';
import { onThemeChange, themeControl } from '../theme';
import { AccountControl, LoginForm, visitor } from './visitor';

export interface View<Data> {
  readonly place: HTMLElement;
  show(data: Data): void;
  resize?(): void;
  recolour?(): void;
  close?(): void;
}

export interface Page<Data> {
  /** Of the program, as it stands in the title. */
  readonly name: string;
  readonly period_ms: number;
  read(): Promise<Data>;
  readonly overview: View<Data>;
  /** Nothing: the overview. */
  viewOf(hash: string): View<Data> | null;
  /** The line at the top, and how many alarms nobody has seen. */
  totals(data: Data): { text: string; open: number };
  /** For screen readers; `before`: the answer of the last time. */
  announce?(data: Data, before: Data | null): void;
}

/** The valve that the address names. */
export function valveOf(hash: string): string | null {
  const valve = /^#\/valve\/([^?]+)/.exec(hash);
  return valve === null ? null : decodeURIComponent(valve[1]!);
}

class Frame<Data> {
  private readonly view = document.getElementById('view')!;
  private readonly totals = document.getElementById('totals')!;
  private readonly stale = document.getElementById('stale')!;
  private readonly links = [...document.querySelectorAll<HTMLAnchorElement>('nav a')];
  private readonly alarmCount = document.getElementById('alarm-count')!;
  private readonly account = new AccountControl(() => this.begin());
  private readonly login = new LoginForm(() => this.begin());
  private shown: View<Data>;
  private last: Data | null = null;
  private answered = performance.now();
  private next = 0;

  constructor(private readonly page: Page<Data>) {
    this.shown = page.overview;
    document.getElementById('controls')!.append(themeControl(), this.account.place);
    window.addEventListener('hashchange', () => this.turn());
    window.addEventListener('keydown', (event) => {
      if (event.key === 'Escape' && this.shown !== page.overview && !(event.target instanceof HTMLSelectElement)) location.hash = '#/';
    });
    window.addEventListener('resize', () => this.shown.resize?.());
    onThemeChange(() => {
      this.shown.recolour?.();
      this.shown.resize?.();
    });
    this.view.replaceChildren(element('p', 'soft', 'Asking the program …'));
  }

  /** At the start, and whenever somebody came or went. */
  begin(): void {
    clearTimeout(this.next);
    void readSession().then((session) => {
      visitor.session = session;
      this.account.show();
      if (session.role === 'none') this.askToLogIn();
      else this.route();
    }).catch(() => undefined).finally(() => void this.follow());
  }

  private route(): void {
    this.shown.close?.();
    this.shown = this.page.viewOf(location.hash) ?? this.page.overview;
    this.view.replaceChildren(this.shown.place);
    if (this.last !== null) this.shown.show(this.last);
    for (const link of this.links) {
      if (link.hash === (location.hash === '' ? '#/' : location.hash)) link.setAttribute('aria-current', 'page');
      else link.removeAttribute('aria-current');
    }
    const title = this.shown === this.page.overview ? '' : this.view.querySelector('h2')?.firstChild?.textContent ?? '';
    document.title = title === '' ? this.page.name : `${title} – ${this.page.name}`;
  }

  private turn(): void {
    if (visitor.session.role === 'none' && visitor.session.accounts) return;
    this.route();
    const heading = this.view.querySelector('h2');
    if (heading !== null && this.shown !== this.page.overview) {
      heading.tabIndex = -1;
      heading.focus({ preventScroll: true });
    }
    scrollTo(0, 0);
  }

  /** Whoever may not read sees nothing but the form. */
  private askToLogIn(): void {
    this.last = null;
    this.shown.close?.();
    this.shown = this.page.overview;
    setText(this.totals, '');
    this.account.show();
    if (!this.view.contains(this.login.place)) {
      this.view.replaceChildren(this.login.place);
      this.login.focus();
    }
  }

  private async ask(): Promise<void> {
    try {
      const data = await this.page.read();
      this.answered = performance.now();
      this.page.announce?.(data, this.last);
      this.last = data;
      const { text, open } = this.page.totals(data);
      setText(this.totals, text);
      setText(this.alarmCount, open === 0 ? '' : String(open));
      this.alarmCount.hidden = open === 0;
      this.shown.show(data);
    } catch (error) {
      if (error instanceof Refusal && error.status === 401) {
        visitor.session = { account: null, role: 'none', accounts: true };
        this.answered = performance.now();
        this.askToLogIn();
      }
      // else shown below, as long as it lasts
    }
  }

  private showAge(): void {
    const age_ms = performance.now() - this.answered;
    this.stale.hidden = age_ms < 3 * this.page.period_ms;
    setText(this.stale, this.stale.hidden ? '' : `The program has not answered for ${(age_ms / 1000).toFixed(0)} s: what is shown is old.`);
    document.body.classList.toggle('old', !this.stale.hidden);
  }

  private async follow(): Promise<void> {
    const begun = performance.now();
    if (!this.view.contains(this.login.place)) await this.ask();
    this.showAge();
    const { period_ms } = this.page;
    this.next = window.setTimeout(() => void this.follow(), Math.max(0.2 * period_ms, period_ms - (performance.now() - begun)));
  }
}

export function run<Data>(page: Page<Data>): void {
  new Frame(page).begin();
}
