// A shop in which much is going on, for pictures: a run, a question of a control, an alarm, a stop, a machine that was switched off.
import { writeFileSync } from 'node:fs';
import path from 'node:path';
import { LineControl } from './line_control';
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

export async function exampleShop(): Promise<Shop> {
  const shop = new Shop();
  const policy = path.join(shop.folder, 'policy.toml');
  writeFileSync(policy, '[approve]\nfour_eyes = true\n[withdraw]\ncomment = true\n[imports]\naccept_at_once = ["comment"]\n');
  shop.serverArgs = ['--policy', policy, '--backups', path.join(shop.folder, 'backups')];
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
  await shop.stopMachine('mill-4');
  await until('lathe-1 asks', async () => {
    const machine = await shop.api<{ status: { waits_for: string } | null }>('GET', 'machines/lathe-1');
    return machine?.status?.waits_for === 'answer';
  });
  return shop;
}
