// A machine, its status and a run with usual values, for tests that are about one of them.
import type { Capability, Import, Job, Machine, Measurement, Offset, Record as ReportRecord, Run, Status } from '../../generated/api';

export function status(changed: Partial<NonNullable<Status>> = {}): NonNullable<Status> {
  return {
    time: '2026-11-23T12:00:00Z', execution: 'READY', mode: 'AUTOMATIC', run: 'run-1', program: 'O0100', sent: 0, accepted: 0, executed: 0,
    total_bytes: 0, offset: 0, line: 1, sequence: null, position: { X: 0, Z: 0 }, feed_mm_per_min: 0, spindle_rpm: 0, feed_override: 1,
    rapid_override: 1, spindle_override: 1, buffered_seconds: 0, single_block: false, message: null, outbox: 0, modes: null, coordinates: null,
    emergency_stop: false, remote_enable: 'unattended', waits_for: 'nothing', screen: null, switches: null, jog: null, ...changed,
  };
}

export function machine(changed: Partial<Machine> = {}, changedStatus: Partial<NonNullable<Status>> = {}): Machine {
  return {
    name: 'lathe-1', control: 'centurion', description: null, gateway_version: '0.1.0', connected: true, stale: false, unconfirmed_gateway: null, clock_ahead_seconds: 0, notices: [], held: null, queue_hold: null,
    first_seen: '2026-11-23T10:00:00Z', last_seen: '2026-11-23T12:00:00Z',
    starts: { at: ['block', 'line', 'byte', 'tool', 'count'], head: false, memory: true, pass: true, mdi: 1 }, positions: { offsets: ['G54', 'G55'], datum_axes: 'Z', tool_axes: 'XZ', x_diameter: true, zero_only: true, playback: false }, display: { units: 'inch', x: 'diameter', fields: ['compensation', 'tool_length_x', 'tool_length_z', 'tool_radius', 'work_system', 'incremental', 'cycle'] }, status: status(changedStatus), ...changed,
  };
}

export function run(changed: Partial<Run> = {}): Run {
  return {
    id: 'run-1', machine: 'lathe-1', program: 'O0100', revision: 1, sha256: '0'.repeat(64), size: 1000, control: 'centurion', state: 'active',
    sent: 0, accepted: 0, executed: 0, line: 0, sequence: null, reason: null, content_verified: null, author: 'admin',
    created: '2026-11-23T12:00:00Z', started: '2026-11-23T12:00:00Z', ended: null, outputs: 0, setup: null, allowed_as: 'open', approval: null, job: null, statistics: null, test: false, ...changed,
  };
}

export function record(changed: Partial<ReportRecord> = {}): ReportRecord {
  return {
    machine: 'lathe-1', epoch: 1, number: 1, time: '2026-11-23T12:00:00Z', received: null, run: 'run-1', kind: 'output', block: 1, line: 1,
    sequence: null, device: null, text: '', ...changed,
  };
}

export function importOf(changed: Partial<Import> = {}): Import {
  return {
    program: 'O0200', revision: 2, machine: 'lathe-2', control: 'centurion', size: 100, sha256: '0'.repeat(64), comment: null, received: '2026-11-23T12:00:00Z',
    state: 'pending', class: 'feed_and_speed', base: 1, fault: null, compared: '2026-11-23T12:00:01Z', decided: null, who: null, reason: null, at_once: false,
    accepted_as: null, ...changed,
  };
}

export function job(changed: Partial<Job> = {}): Job {
  return {
    id: 1, machine: 'mill-1', program: 'O0200', revision: null, quantity: 1, parts_per_run: 1, counts: 'made', completed: 0, good: 0, unknown: 0, rework: 0, scrap: 0, runs: 0, state: 'waiting', comment: null,
    author: 'admin', created: '2026-11-23T12:00:00Z', ...changed,
  };
}

export function offset(changed: Partial<Offset> = {}): Offset {
  return {
    id: 1, machine: 'lathe-1', rule: 'L', target: 'T3.wear.Z', unit: 'mm', old_value: 0, new_value: 0.025, base: 1, state: 'pending', used: 3, left_out: 0, mean: 0.025, first: 1,
    last: 3, reasons: ['mean of 3'], created: '2026-11-23T12:00:00Z', decided: null, who: null, comment: null, automatic: false, setup: null, ...changed,
  };
}

export function measurement(changed: Partial<Measurement> = {}): Measurement {
  return {
    id: 1, machine: 'lathe-1', run: 'run-1', program: 'O0100', revision: 1, block: 1, line: 1, part: 1, part_number: null, serial: null, tool: null, characteristic: 'D12',
    nominal: 12, lower: 11.9, upper: 12.1, unit: 'mm', decimals: 3, actual: 12, deviation: 0, time: '2026-11-23T12:00:00Z', epoch: 1, number: 1, item: 0, verdict: 'good', ...changed,
  };
}

export function capability(changed: Partial<Capability> = {}): Capability {
  return {
    count: 50, mean: 12, standard_deviation: 0.02, minimum: 11.95, maximum: 12.05, lower: 11.9, upper: 12.1, shape: 'normal', sigma_within: 0.02, within_by: 'moving range',
    confidence: 0.95, cp: { value: 1.67, low: 1.4, high: 2 }, cpk: { value: 1.6, low: 1.3, high: 1.9 }, pp: { value: 1.67, low: 1.4, high: 2 }, ppk: { value: 1.6, low: 1.3, high: 1.9 },
    below: 0, above: 0, expected_outside_ppm: 0.6, percentiles: [11.94, 12, 12.06], percentiles_reached: true, anderson_darling: { statistic: 0.3, adjusted: 0.3, p_value: 0.5 }, ...changed,
  };
}
