/** What a report page does beyond being read: colours, units, plots that zoom. Without it the page still shows all. */
import { choices, ReadersUnits, type Choice } from './readers_units';
import { RunPlots } from './run_plots';
import { themeControl } from './theme';

performance.mark('spoolflow begin');
const units = new ReadersUnits(document.documentElement.dataset);
const figures = [...document.querySelectorAll<HTMLElement>('figure.run-plots')];

function unitControl({ quantity, label, names }: Choice): HTMLElement {
  const out = document.createElement('label');
  out.textContent = `${label} in `;
  const select = document.createElement('select');
  select.name = quantity;
  for (const name of names) select.add(new Option(name));
  select.selectedIndex = units.chosenOf(quantity);
  select.addEventListener('change', () => units.choose(quantity, select.selectedIndex));
  out.append(select);
  return out;
}

function addControls(): void {
  const controls = document.createElement('div');
  controls.className = 'controls';
  controls.append(themeControl());
  if (figures.length > 0) {
    const plots = document.createElement('span');
    plots.className = 'unit-controls';
    plots.append('Plots over time: ', ...choices.map(unitControl));
    const others = document.createElement('span');
    others.className = 'hint';
    others.textContent = 'Other figures, tables and print keep the units that the page was made in (--units).';
    plots.append(others);
    const below = document.createElement('div');
    below.className = 'controls';
    below.append(plots);
    figures[0].before(below); // where the plots are that they are for
  }
  document.querySelector('header')?.append(controls);
}

function bringToLife(figure: HTMLElement): void {
  const from = performance.now();
  new RunPlots(figure, units);
  performance.measure('spoolflow plots', { start: from, end: performance.now() });
}

addControls();
// Runs far down a long page come to life when the reader comes near them.
const near = new IntersectionObserver((entries) => {
  for (const entry of entries) {
    if (!entry.isIntersecting) continue;
    near.unobserve(entry.target);
    bringToLife(entry.target as HTMLElement);
  }
}, { rootMargin: '800px' });
for (const figure of figures) near.observe(figure);
performance.measure('spoolflow page', 'spoolflow begin');
