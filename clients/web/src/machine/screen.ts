// What the control's own screen shows: its position, its fields, its blocks. Pure.
import type { Display, Status } from '../../generated/api';

type Shown = NonNullable<Status>;
type Axes = { [axis: string]: number };

export type PositionKind = 'actual' | 'reference' | 'nominal' | 'distance_to_go' | 'following_error';

/// The positions that are known, the one that the control's operator has chosen first; where the control has that choice, the nominal one too.
export function positionsOf(status: Shown): Array<[PositionKind, Axes]> {
  const { coordinates, screen } = status;
  const all: Array<[PositionKind, Axes | null | undefined]> = [
    ['actual', coordinates?.program?.position], ['reference', status.position], ['distance_to_go', coordinates?.distance_to_go],
    ['following_error', coordinates?.following_error]];
  if (screen?.position === 'nominal') all.push(['nominal', coordinates?.program?.target ?? coordinates?.target]);
  const known = all.filter((entry): entry is [PositionKind, Axes] => entry[1] != null);
  const chosen = known.filter(([kind]) => kind === screen?.position);
  return [...chosen, ...known.filter(([kind]) => kind !== screen?.position)];
}

/// Whether the control has this member of the modes.
export function hasField(display: Display, field: NonNullable<Display>['fields'][number]): boolean {
  return !display || display.fields.includes(field);
}

export interface ShownBlock {
  text: string;
  isExecuting: boolean;
}

/// As the size of its characters allows; none where no text is at hand.
export function blocksOf(status: Shown): ShownBlock[] {
  const { screen } = status;
  if (!screen) return [];
  const all: Array<[string | null, boolean]> = [[screen.previous_block, false], [screen.block, true], [screen.next_block, false], [screen.further_block, false]];
  return all.filter((entry): entry is [string, boolean] => entry[0] !== null).map(([text, isExecuting]) => ({ text, isExecuting }));
}

/// Those that are neither 0 nor vacant: most of a control's thousands are.
export function usedValues<T extends { value: number | null }>(values: T[]): T[] {
  return values.filter(({ value }) => value !== null && value !== 0);
}
