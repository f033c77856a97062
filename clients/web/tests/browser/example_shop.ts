// A shop in which much is going on, for pictures: a run, a question of a control, an alarm, a stop, a machine that was switched off, jobs that wait,
// parts that were measured.
import { mkdirSync, writeFileSync } from 'node:fs';
import path from 'node:path';
import { LineControl } from './line_control';
import { addMeasuringLathe, makePart } from './measured_shop';
import { Shop, longProgram, measuringProgram, until } from './shop';

const kAsks = 'O0300 (DIAMETERS FROM THE OPERATOR)\nG20 G93 G98\nINPUT (LARGEST DIAMETER) P1\nG0 X[P1]\nM30\n';
const kStops = 'O0400 (TURN THE PART OVER)\nG21 G90\nG0 X10.\nM0\nG0 X0.\nM30\n';

/// A pocket in spirals, each deeper, with a drilled pattern around it.
function spiralProgram(): string {
  const lines = ['O0600 (POCKET AND HOLES)', 'G21 G90 G94 G17 G54', 'T1 M6 (END MILL)', 'S4000 M3', 'G0 X0. Y0. Z5.'];
  for (const depth of [-3, -6, -9, -12]) {
    lines.push('G0 X0. Y0.', `G1 Z${depth}. F200.`);
    for (let i = 1; i <= 240; ++i) {
      const [radius, angle] = [i / 6, i / 8];
      lines.push(`G1 X${(radius * 1.4 * Math.cos(angle)).toFixed(3)} Y${(radius * Math.sin(angle)).toFixed(3)} F900.`);
    }
    lines.push('G0 Z5.');
  }
  lines.push('T2 M6 (DRILL)', 'S2500 M3');
  for (let i = 0; i < 12; ++i) {
    const angle = (i * Math.PI) / 6;
    lines.push(`G${i === 0 ? '81' : ''} X${(75 * Math.cos(angle)).toFixed(3)} Y${(58 * Math.sin(angle)).toFixed(3)}${i === 0 ? ' Z-18. R2. F150.' : ''}`.replace('G X', 'X'));
  }
  lines.push('G80', 'G0 Z20.', 'G0 X90. Y0.', 'G1 Z-2. F300.', 'G3 X90. Y0. I-90. J0. F2000.', 'G0 Z20.', 'M30', '');
  return lines.join('\n');
}

const kSetup = `units = "mm"

[[tool]]          # face mill
number = 1
length = 142.315
radius = 25.0

[[tool]]          # drill
number = 2
length = 118.402
radius = 4.25

[[offset]]
name = "G54"
X = -250.0
Y = -180.0
Z = -312.75

[[variable]]
name = "#500"
value = 12.5
`;

/// What belongs to a program besides its text, with one that it calls and one that is missing.
async function addLibrary(shop: Shop): Promise<void> {
  await shop.push('O0610', 'O0610 (DEEP POCKET, FINISH)\nG1 X1. F100.\nM99\n', 'fanuc');
  await shop.push('O0620', 'O0620 (BRACKET, BOTH SIDES)\nG21 G90\nM98 P610\nM98 P611\nM30\n', 'fanuc', 'from the second office');
  const fields = { part: 'Bracket 7-114', operation: '20', material: 'EN AW-6082', machine_group: 'cell-1', cam_file: 'bracket-7-114.prt' };
  await shop.api('PUT', 'programs/O0620/fields', fields);
  await shop.api('PUT', 'programs/O0610/fields', { part: fields.part, material: fields.material });
  for (const name of ['setup sheet 7-114.pdf', 'fixture.jpg']) {
    const upload = await shop.api<{ id: string }>('POST', 'programs/O0620/attachments', { name });
    await shop.api('PUT', `uploads/${upload!.id}/content?offset=0`, name.repeat(4000));
    await shop.api('POST', `uploads/${upload!.id}/attach`, {});
  }
}

async function addJobs(shop: Shop): Promise<void> {
  const jobs = 'machines/mill-2/jobs';
  await shop.api('POST', jobs, { program: 'O0600', quantity: 25, comment: 'steel, fixture 7' });
  await shop.api('POST', jobs, { program: 'O0620', quantity: 8, parts_per_run: 4, comment: 'pallet B' });
  await shop.api('POST', jobs, { program: 'O0100', revision: 1 });
  await shop.api('POST', 'machines/mill-3/jobs', { program: 'O0600', quantity: 3 });
  await shop.api('PUT', 'machines/mill-3/job-hold', { reason: 'the probe is being calibrated' });
}

async function addMeasurements(shop: Shop): Promise<void> {
  await addMeasuringLathe(shop);
  for (let i = 0; i < 16; ++i) await makePart(shop, { length: 1 + 0.0006 * i, diameter: 2 + 0.003 * Math.sin(i) + (i === 11 ? 0.004 : 0), ...(i === 4 && { more: 'TOOL 3 IS WARM' }) });
  await until('a correction is proposed', async () => (await shop.api<{ offsets: unknown[] }>('GET', 'offsets?state=pending'))?.offsets.length === 1);
  const { offsets } = (await shop.api<{ offsets: Array<{ id: number }> }>('GET', 'offsets?state=pending'))!;
  await shop.api('POST', `machines/lathe-3/offsets/${offsets[0]!.id}/approve`, { comment: 'checked with a gauge' });
  for (let i = 0; i < 5; ++i) await makePart(shop, { length: 1.003 + 0.0008 * i, diameter: 2.001 });
}

export async function exampleShop(): Promise<Shop> {
  const shop = new Shop();
  const policy = path.join(shop.folder, 'policy.toml');
  writeFileSync(policy, '[approve]\nfour_eyes = true\n[withdraw]\ncomment = true\n[imports]\naccept_at_once = ["comment"]\n');
  const folder = path.join(shop.folder, 'cam');
  mkdirSync(folder);
  const settings = path.join(shop.folder, 'dncd.toml');
  writeFileSync(settings, `[[folder]]\nname = "cam-mills"\npath = ${JSON.stringify(folder)}\ncontrol = "fanuc"\npoll_seconds = 1\n`);
  writeFileSync(path.join(folder, 'O0810.nc'), 'O0810 (POSTED)\nG21 G90\nG1 X10. F100.\nM30\n');
  writeFileSync(path.join(folder, 'O0811.nc'), 'O0811 (WITH AN ALARM)\nG21 G90\nG1 X10. F100.\nG999\nM30\n');
  shop.serverArgs = ['--config', settings, '--policy', policy, '--backups', path.join(shop.folder, 'backups'), '--archives', path.join(shop.folder, 'archives'), '--archive-records-thousands', '1'];
  await shop.startServer();
  await shop.startMachine('mill-1', { control: 'fanuc', description: 'Vertical, three axes' });
  await shop.startMachine('mill-2', { control: 'fanuc', description: 'Vertical, pallet changer' });
  await shop.startMachine('mill-3', { control: 'fanuc', description: 'Horizontal' });
  await shop.startMachine('mill-4', { control: 'fanuc', description: 'Test bench' });
  await shop.startMachine('lathe-1', { control: 'centurion', description: 'Turning, probe' });
  await shop.startMachine('lathe-2', { control: 'centurion' });
  await shop.api('PUT', 'machine-groups/cell-1');
  await shop.push('O0100', longProgram('O0100', 3000), 'fanuc');
  await shop.push('O0200', 'O0200 (WITH AN ERROR)\nG21 G90\nG1 X1. F100. ZZ5.\nM30\n', 'fanuc');
  await shop.push('O0300', kAsks, 'centurion');
  await shop.push('O0400', kStops, 'fanuc');
  await shop.api('PUT', 'machines/mill-1/setup?comment=As+measured', kSetup);
  await shop.api('PUT', 'machines/mill-1/setup?comment=Tool+2+reground', kSetup.replace('118.402', '117.95'));
  await shop.start('mill-1', 'O0100');
  await shop.start('mill-2', 'O0200');
  await shop.start('mill-3', 'O0400');
  await shop.start('lathe-1', 'O0300');
  for (const machine of ['mill-1', 'mill-2', 'lathe-1']) await shop.api('PUT', `machine-groups/cell-1/machines/${machine}`);
  await shop.push('O0510', measuringProgram(1200).replace('O0500', 'O0510'), 'centurion'); // more than the archives leave
  await shop.start('lathe-2', 'O0510');
  await until('lathe-2 has measured', async () => (await shop.api<{ runs: Array<{ state: string }> }>('GET', 'runs?machine=lathe-2'))?.runs[0]?.state === 'completed');
  await shop.push('O0500', measuringProgram(40), 'centurion');
  await shop.start('lathe-2', 'O0500');
  await shop.push('O0600', spiralProgram(), 'fanuc');
  const bracket = spiralProgram().replace(/O0600.*/, 'O0700 (BRACKET)').split('\n');
  await shop.push('O0700', bracket.join('\n'), 'fanuc');
  bracket[12] = bracket[12]!.replace(/X(-?\d+)/, 'X$12');
  await shop.push('O0700', bracket.join('\n').replace('S2500', 'S2200').replace('R2. F150.', 'R2. F120. (SLOWER)').replace('I-90. J0. F2000.', 'R90. F2000.'), 'fanuc');
  await shop.addUser('anna', 'programmer', ['cell-1']);
  await shop.addUser('otto', 'operator', ['cell-1']);
  await shop.addUser('vera', 'viewer');
  await shop.api('PUT', 'ports/line-5', { machine: 'mill-5', address: '/dev/ttyUSB0', template: 'tnc155' });
  const control = await LineControl.listen();
  await shop.api('PUT', 'ports/line-6', { machine: 'mill-6', address: control.address, template: 'fanuc' });
  await control.punch(`%\n${bracket.join('\n').replace('F900.', 'F1100.').replace('Z-6.', 'Z-6.5')}%\n`);
  await shop.push('O0900', 'O0900 (LOOK AT ME)\nG20 G90 F500.\nG1 X1. F5\nG1 X10.\nX2. ZZ5.\nM30\n', 'fanuc');
  await shop.api('POST', 'programs/O0600/revisions/1/submit', { comment: 'second side' });
  await addLibrary(shop);
  await addJobs(shop);
  await addMeasurements(shop);
  await shop.api('POST', 'webhooks', { name: 'mes', url: 'http://127.0.0.1:9/dripline', kinds: ['run', 'alarm', 'part'] });
  await shop.api('POST', 'archives');
  await shop.stopMachine('mill-4');
  await until('lathe-1 asks', async () => {
    const machine = await shop.api<{ status: { waits_for: string } | null }>('GET', 'machines/lathe-1');
    return machine?.status?.waits_for === 'answer';
  });
  return shop;
}
