/** Small pieces of a page. */
export function element<Name extends keyof HTMLElementTagNameMap>(name: Name, className: string): HTMLElementTagNameMap[Name] {
  const out = document.createElement(name);
  out.className = className;
  return out;
}

export function button(text: string, label: string, act: () => void): HTMLButtonElement {
  const out = element('button', 'tool');
  out.type = 'button';
  out.textContent = text;
  out.setAttribute('aria-label', label);
  out.title = label;
  out.addEventListener('click', act);
  return out;
}
