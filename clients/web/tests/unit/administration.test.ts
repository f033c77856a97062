// The logic of the administration: where a port's settings come from, what ends first, names of programs, ages.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import type { Certificate, PortSetting, PortTemplate } from '../../generated/api';
import { sortCertificates } from '../../src/administration/certificates';
import { folderTone, kindsToSend, kKinds, webhookTone } from '../../src/administration/folder_state';
import { readTypedSettings, shownSettings, unknownSettings } from '../../src/administration/port_settings';
import { readNames } from '../../src/administration/port_transfer';
import { relativeText } from '../../src/texts/texts';

const kSettings: PortSetting[] = ['line', 'baud', 'flow', 'eob'].map((key) => ({ key, type: 'word', text: `what ${key} decides`, default: `usual ${key}` }));
const kTemplate: PortTemplate = { name: 'tnc155', title: 'TNC', control: 'tnc155', settings: { line: '2400e71', baud: '2400', flow: 'dc_codes' } };
const valuesOf = (own: Record<string, string>, template: PortTemplate | null = kTemplate) =>
  Object.fromEntries(shownSettings(kSettings, template ?? undefined, own).map(({ key, value, from }) => [key, `${from}: ${value}`]));

test('a setting of the port comes before that of the template, and that before the usual one', () => {
  assert.deepEqual(valuesOf({ flow: 'xonxoff' }), { line: 'template: 2400e71', baud: 'template: 2400', flow: 'own: xonxoff', eob: 'default: usual eob' });
  assert.equal(valuesOf({}, null).baud, 'default: usual baud');
});

test('the word of a line decides what is in it, unless the port says otherwise', () => {
  assert.equal(valuesOf({ line: '9600e72' }).baud, 'line: null');
  assert.equal(valuesOf({ line: '9600e72', baud: '4800' }).baud, 'own: 4800');
});

test('an unknown setting is named', () => {
  assert.deepEqual(unknownSettings(kSettings, { baud: '1', speed: '2' }), ['speed']);
});

test('of settings that are being typed, the lines that can be read apply', () => {
  assert.deepEqual(readTypedSettings('eob = lf\nbaud =\nline\rx = 1\nxon = "DC1"'), { eob: 'lf', xon: 'DC1' });
});

test('programs are taken apart at blanks and commas', () => {
  assert.deepEqual(readNames(' O0100,O0200@3\n,15 '), ['O0100', 'O0200@3', '15']);
  assert.deepEqual(readNames(' , '), []);
});

test('the certificate that ends first is first', () => {
  const ends = (expires: string) => ({ expires }) as Certificate;
  assert.deepEqual(sortCertificates([ends('2027-01-01T00:00:00Z'), ends('2026-01-01T00:00:00Z')]).map(({ expires }) => expires.slice(0, 4)), ['2026', '2027']);
});

test('ages are in the largest unit that fills', () => {
  const now = Date.parse('2026-11-24T12:00:00Z');
  const ages = ['2026-11-24T11:59:58Z', '2026-11-24T11:01:00Z', '2026-11-23T11:00:00Z', '2026-12-24T12:00:00Z'].map((time) => relativeText(time, now));
  assert.deepEqual(ages, ['2 seconds ago', '59 minutes ago', '1 day ago', 'in 30 days']);
});

test('a folder that cannot be read is an alarm, one that refused a file needs a look', () => {
  const folder = (changed: object) => folderTone({ fault: null, waiting: 0, failed: 0, last_refused: null, ...changed } as never);
  assert.deepEqual([{}, { waiting: 1 }, { failed: 1 }, { last_refused: 'a.nc' }, { fault: 'no such folder' }].map(folder), ['ready', 'running', 'waiting', 'waiting', 'alarm']);
});

test('a webhook that lost events is an alarm; one for all kinds names none', () => {
  assert.deepEqual([{ failures: 0, lost: 0 }, { failures: 3, lost: 0 }, { failures: 0, lost: 1 }].map((webhook) => webhookTone(webhook as never)), ['ready', 'waiting', 'alarm']);
  assert.deepEqual([kindsToSend(kKinds), kindsToSend(['job', 'run'])], [{}, { kinds: ['run', 'job'] }]);
});
