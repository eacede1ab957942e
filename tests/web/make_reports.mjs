// node make_reports.mjs FOLDER COMMAND MODEL: recordings that have something special, and the reports on them.
import { execFileSync } from 'node:child_process';
import { existsSync, statSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { channels, gap, long } from './recordings.mjs';

const [, , folder, command, model] = process.argv;
const newest = Math.max(statSync(command).mtimeMs, statSync(model).mtimeMs);

function run(...args) {
  execFileSync(command, [...args, '-q'], { cwd: folder, stdio: ['ignore', 'ignore', 'inherit'] });
}

function write(name, rows, { reference = true, voltage = false } = {}) {
  const head = ['time_s', 'current_A', 'position_mm', 'oil_temperature_C', 'pressure_difference_bar'];
  if (voltage) head.push('voltage_V');
  if (reference) head.push('flow_reference_L_min');
  const lines = [head.join(',')];
  for (const k of rows) {
    const sample = channels(k);
    lines.push(head.map((channel) => sample[channel]).join(','));
  }
  writeFileSync(join(folder, `${name}.csv`), lines.join('\n') + '\n');
}

const range = (from, to) => Array.from({ length: to - from }, (_value, k) => from + k);
const made = join(folder, 'million.html');
if (!existsSync(made) || statSync(made).mtimeMs < newest) {
  write('usual', range(0, 20000));
  write('unmeasured', range(0, 5000), { reference: false });
  write('gaps', [...range(0, gap.from), ...range(gap.to, 10000)]);
  write('single', [0]);
  write('million', range(0, long));
  run('estimate', model, 'usual.csv', '-o', 'usual_estimate.csv');
  run('validate', model, 'usual.csv', 'unmeasured.csv', '--report', 'usual.html', '--json', 'usual.json');
  const limits = '[[limit]]\nfigure = "p95"\nat_most = 5\n\n[[limit]]\nrun = "each"\nfigure = "fault_share"\nat_most = 100\n';
  writeFileSync(join(folder, 'limits.toml'), limits);
  run('validate', model, 'gaps.csv', '--report', 'gaps.html', '--requirements', 'limits.toml', '--compare', 'usual.json');
  const scenario = [
    '[points]', 'positions_percent = [50, 95]', 'pressure_differences_bar = [20, 60]',
    '[monte_carlo]', 'trials = 200', 'trials_along_run = 20',
    '[map]', 'positions = 12', 'pressure_differences = 8',
    '[study]', 'base_samples = 2', 'run_s = 1', 'given_model = true'];
  writeFileSync(join(folder, 'few.toml'), scenario.join('\n') + '\n');
  run('analyse', model, '--scenario', 'few.toml', '--recording', 'gaps.csv', '--report', 'analysis.html');
  run('analyse', model, '--scenario', 'few.toml', '--recording', 'gaps.csv', '--report', 'american.html',
    '--units', 'gal/min,psi,in,F,lbf');
  run('validate', model, 'single.csv', '--report', 'imperial.html', '--units', 'gal/min,psi,in,F,lbf');
  write('ramp at 60 bar', range(0, 2000), { voltage: true });
  run('validate', model, 'ramp at 60 bar.csv', '--report', 'named.html', '--units', 'psi');
  for (const name of ['unmeasured', 'single', 'million']) {
    run('validate', model, `${name}.csv`, '--report', `${name}.html`);
  }
}
