/** Colours of the style sheet, as the page shows them now. */
export function colour(tone: string): string {
  return getComputedStyle(document.documentElement).getPropertyValue(`--${tone}`).trim() || 'gray';
}

/** The same colour, so pale that what lies below still shows. */
export function paleColour(tone: string, share: number): string {
  const hex = colour(tone);
  return hex.length === 7 ? hex + Math.round(255 * share).toString(16).padStart(2, '0') : hex;
}
