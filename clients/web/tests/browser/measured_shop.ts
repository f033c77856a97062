// A lathe that measures its parts: what it prints is read by a template, and a rule proposes a correction of its tool.
import { until, type Shop } from './shop';

export const kHostile = '<img src=x onerror=alert(1)>';

const kTemplate = `[[line]]
form = "L {actual}"
characteristic = "L"
nominal = 1.0
lower = 0.99
upper = 1.01
unit = "in"
tool = "T3"
decimals = 4
[[line]]
form = "DIA {actual}"
characteristic = "DIA"
nominal = 2.0
lower = 1.995
upper = 2.005
unit = "in"
rework = "above"
decimals = 4
`;

const kSetup = 'units = "in"\n\n[[tool]]\nnumber = 3\nwear = { Z = 0.0 }  # finishing\n';

const kRules = `[[rule]]
name = "length"
characteristic = "L"
target = "T3.wear.Z"
scale = -1
gain = 1.0
dead_band = 0.0005
max_step = 0.1
min_count = 3
window = 3
outlier = 0
`;

export interface Measured {
  length: number;
  diameter: number;
  /// A line that no template knows.
  more?: string;
}

function programOf({ length, diameter, more }: Measured): string {
  const lines = [`L ${length.toFixed(4)}`, `DIA ${diameter.toFixed(4)}`, ...(more === undefined ? [] : [more])];
  return ['O0900 (SHAFT)', 'G20 G93 G98', 'POPEN P0', ...lines.map((line) => `DPRNT [${line}]`), 'PCLOS', 'M30', ''].join('\n');
}

async function put(shop: Shop, what: string, text: string): Promise<void> {
  if ((await shop.api('PUT', what, text)) === null) throw new Error(`${what} is refused: ${shop.lastRefusal}`);
}

export async function addMeasuringLathe(shop: Shop): Promise<void> {
  await shop.startMachine('lathe-3', { control: 'centurion', speed: 'max', description: 'Turning, gauge' });
  await put(shop, 'machines/lathe-3/setup', kSetup);
  await put(shop, 'report-templates/shaft', kTemplate);
  await put(shop, 'report-template-assignments/program/O0900/shaft', '');
  // A machine is shown before it is stored, and rules need one that is stored.
  await until('the machine is stored', async () => (await shop.api('PUT', 'machines/lathe-3/offset-rules', kRules)) !== null);
}

/// Runs a part to its end, and waits until it is measured.
export async function makePart(shop: Shop, measured: Measured): Promise<string> {
  await shop.push('O0900', programOf(measured), 'centurion');
  const run = await shop.start('lathe-3', 'O0900');
  await until('the part is measured', async () => {
    const answer = await shop.api<{ parts: Array<{ ended: string | null }> }>('GET', `parts?run=${run}`);
    return answer !== null && answer.parts.length > 0 && answer.parts[0]!.ended !== null;
  });
  return run;
}
