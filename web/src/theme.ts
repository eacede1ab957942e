/** Light and dark: as the system says, or as the reader chose. */
type Theme = 'system' | 'light' | 'dark';

const place = 'spoolflow-theme';
const listeners: (() => void)[] = [];

function remembered(): Theme {
  try {
    const theme = localStorage.getItem(place);
    return theme === 'light' || theme === 'dark' ? theme : 'system';
  } catch {
    return 'system';  // a page opened from a file may have no storage
  }
}

function remember(theme: Theme): void {
  try {
    localStorage.setItem(place, theme);
  } catch {
    return;  // then the choice holds for this page only
  }
}

function show(theme: Theme): void {
  if (theme === 'system') delete document.documentElement.dataset.theme;
  else document.documentElement.dataset.theme = theme;
  for (const listener of listeners) listener();
}

export function onThemeChange(listener: () => void): void {
  listeners.push(listener);
}

/** Shows the remembered theme and returns the control by which the reader changes it. */
export function themeControl(): HTMLElement {
  const label = document.createElement('label');
  label.textContent = 'Colours ';
  const select = document.createElement('select');
  select.className = 'theme';
  for (const [value, text] of [['system', 'as the system'], ['light', 'light'], ['dark', 'dark']]) {
    select.add(new Option(text, value));
  }
  select.value = remembered();
  show(remembered());
  select.addEventListener('change', () => {
    remember(select.value as Theme);
    show(select.value as Theme);
  });
  matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => show(select.value as Theme));
  label.append(select);
  return label;
}
