// All that the page says is in one file for each language; a language is one more file and a row here.
import { en, type Texts } from './en';

export type { Texts };

export const languages = {
  en: { name: 'English', load: async (): Promise<Texts> => en },
  de: { name: 'Deutsch', load: async (): Promise<Texts> => (await import('./de')).de },
};
export type Language = keyof typeof languages;

let current: Texts = en;
let language: Language = 'en';

/// Before the page is shown; another language needs the page to be drawn again.
export async function loadTexts(wanted: Language): Promise<void> {
  current = await languages[wanted].load();
  language = wanted;
  document.documentElement.lang = wanted;
}

export function texts(): Texts {
  return current;
}

/// By language and digits: to make one takes a hundred times as long as to use it, and a floor writes thousands of numbers a second.
const numberFormats = new Map<string, Intl.NumberFormat>();

/// A number as this language writes it.
export function numberText(value: number, digits = 0): string {
  const key = `${language} ${digits}`;
  let format = numberFormats.get(key);
  if (!format) numberFormats.set(key, format = new Intl.NumberFormat(language, { minimumFractionDigits: digits, maximumFractionDigits: digits }));
  return format.format(value);
}

export function timeText(time: Date | string): string {
  return new Date(time).toLocaleTimeString(language, { hour: '2-digit', minute: '2-digit', second: '2-digit' });
}

export function dateTimeText(time: Date | string): string {
  return new Date(time).toLocaleString(language, { dateStyle: 'medium', timeStyle: 'medium' });
}

/// "3 days ago", "in 2 weeks": rounded, for people.
export function relativeText(time: Date | string, now = Date.now()): string {
  const seconds = (new Date(time).getTime() - now) / 1000;
  const units: Array<[Intl.RelativeTimeFormatUnit, number]> = [['day', 86_400], ['hour', 3600], ['minute', 60], ['second', 1]];
  const [unit, size] = units.find(([, length]) => Math.abs(seconds) >= length) ?? units[units.length - 1]!;
  return new Intl.RelativeTimeFormat(language, { numeric: 'always' }).format(Math.trunc(seconds / size), unit);
}

/// How long a machine can do without the server: "12.3 s", and minutes of a line beside a gateway, "10.1 min".
export function bufferedText(seconds: number): string {
  return seconds < 120 ? `${numberText(seconds, 1)} s` : `${numberText(seconds / 60, 1)} min`;
}

export function bytesText(bytes: number): string {
  const units = ['B', 'KiB', 'MiB', 'GiB', 'TiB'];
  let unit = 0;
  for (; bytes >= 1024 && unit < units.length - 1; ++unit) bytes /= 1024;
  return `${numberText(bytes, unit === 0 ? 0 : 1)}\u00a0${units[unit]}`; // the unit stays with its number
}
