// Numbers as the control shows them: in its unit, X of some lathes as a diameter. The API's lengths are millimeters and radii. Pure.
import type { Display } from '../../generated/api';
import { numberText } from '../texts/texts';

const kRotary = 'ABC';
const kMmPerInch = 25.4;

export interface LengthUnit {
  name: 'mm' | 'inch';
  perMm: number;
  digits: number;
}

export const kInch: LengthUnit = { name: 'inch', perMm: 1 / kMmPerInch, digits: 4 };
export const kMillimeter: LengthUnit = { name: 'mm', perMm: 1, digits: 3 };

/// Of a control that is not known: millimeters.
export function unitOf(display: Display): LengthUnit {
  return display?.units === 'inch' ? kInch : kMillimeter;
}

export function isRotary(axis: string): boolean {
  return kRotary.includes(axis);
}

/// Whether this axis is shown as a diameter.
export function isDiameter(axis: string, display: Display): boolean {
  return axis === 'X' && display?.x === 'diameter';
}

/// Of an axis: rotary ones are in degrees, whatever the unit.
export function axisText(axis: string, value: number | undefined, unit: LengthUnit, isDoubled = false): string {
  if (value === undefined) return '–';
  return isRotary(axis) ? `${numberText(value, 3)}°` : lengthText(isDoubled ? 2 * value : value, unit);
}

export function lengthText(mm: number, unit: LengthUnit): string {
  const value = mm * unit.perMm;
  const isNothing = Math.abs(value) < 0.5 * 10 ** -unit.digits; // no "-0.000"
  return numberText(isNothing ? 0 : value, unit.digits);
}

/// In the order of a control's display.
export function sortAxes(axes: string[]): string[] {
  return [...axes].sort((a, b) => 'XYZABCUVW'.indexOf(a) - 'XYZABCUVW'.indexOf(b));
}
