/** Who looks at the page, and how they log in. */
import { logIn, logOut, Refusal, type Session } from './api';
import { element, setText } from './element';

/** Until the program has answered, nobody may do anything. */
export const visitor: { session: Session } = { session: { account: null, role: 'none', accounts: false } };

export class LoginForm {
  readonly place = element('form', 'login');
  private readonly name = element('input', '');
  private readonly password = element('input', '');
  private readonly button = element('button', '', 'Log in');
  private readonly trouble = element('p', 'stale');

  constructor(private readonly done: () => void) {
    this.name.name = 'name';
    this.name.autocomplete = 'username';
    this.name.required = true;
    this.password.name = 'password';
    this.password.type = 'password';
    this.password.autocomplete = 'current-password';
    this.password.required = true;
    this.button.type = 'submit';
    this.trouble.setAttribute('role', 'alert');
    this.place.append(element('h2', '', 'Log in'), element('label', '', 'Name', this.name),
                      element('label', '', 'Password', this.password), this.button, this.trouble);
    this.place.addEventListener('submit', (event) => {
      event.preventDefault();
      void this.send();
    });
  }

  focus(): void {
    this.name.focus();
  }

  private async send(): Promise<void> {
    this.button.disabled = true;
    try {
      visitor.session = await logIn(this.name.value, this.password.value);
      this.password.value = '';
      setText(this.trouble, '');
      this.done();
    } catch (error) {
      setText(this.trouble, error instanceof Refusal ? error.message : 'The program does not answer.');
    }
    this.button.disabled = false;
  }
}

/** Who is logged in, and a button that ends it; nothing where there are no accounts. */
export class AccountControl {
  readonly place = element('span', 'account');
  private readonly button = element('button', '', 'Log out');
  private readonly name = element('span', '');

  constructor(done: () => void) {
    this.button.type = 'button';
    this.button.addEventListener('click', () => void logOut().then((session) => {
      visitor.session = session;
      done();
    }));
    this.place.append(this.name, ' ', this.button);
    this.show();
  }

  show(): void {
    const { account, role } = visitor.session;
    this.place.hidden = account === null;
    setText(this.name, account === null ? '' : `${account} (${role === 'read' ? 'reads' : 'acknowledges'})`);
  }
}
