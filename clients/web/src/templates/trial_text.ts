// What a line of a report brings by a template, in words. Pure.
import type { TemplateTrial } from '../../generated/api';
import { texts } from '../texts/texts';

export type TriedLine = TemplateTrial['shown'][number];
export type TrialEvent = TriedLine['events'][number];

export function eventText(event: TrialEvent): string {
  const t = texts().templates;
  const m = texts().measurements;
  const verdict = event.verdict === undefined ? '' : m.verdicts[event.verdict];
  switch (event.event) {
    case 'measurement': return t.value(event.characteristic ?? '', `${event.actual} ${event.unit ?? ''}`.trim(), verdict);
    case 'finding': return `${event.kind === undefined ? '' : m.findingKinds[event.kind]}: ${event.text ?? ''}`;
    case 'part_begun': return t.partBegun;
    case 'part_ended': return t.partEnded([event.part_number, event.serial].filter(Boolean).map((name) => ` ${name}`).join(''), verdict);
  }
}

/// "actual 40.001, serial 7": as the line has them.
export function fieldsText(fields: TriedLine['fields']): string {
  return Object.entries(fields).map(([name, value]) => `${name} ${value}`).join(', ');
}
