/** HTML elements with their text; text is never read as HTML. */
export function element<Tag extends keyof HTMLElementTagNameMap>(tag: Tag, className: string,
                                                                 ...content: (string | Node)[]): HTMLElementTagNameMap[Tag] {
  const made = document.createElement(tag);
  if (className !== '') made.className = className;
  made.append(...content);
  return made;
}

/** Writes only where something changed, so that screen readers and the layout stay quiet. */
export function setText(place: HTMLElement, text: string): void {
  if (place.textContent !== text) place.textContent = text;
}

export function row(tag: 'td' | 'th', ...cells: string[]): HTMLTableRowElement {
  return element('tr', '', ...cells.map((cell) => element(tag, '', cell)));
}
