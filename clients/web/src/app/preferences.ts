// What this browser's user has chosen: language and theme. Nothing of it leaves the browser.
import { languages, type Language } from '../texts/texts';

export type Theme = 'system' | 'light' | 'dark';

const kKey = 'dripline.preferences';

interface Preferences {
  language: Language;
  theme: Theme;
}

function browserLanguage(): Language {
  const wanted = navigator.languages.map((tag) => tag.slice(0, 2));
  return (wanted.find((tag) => tag in languages) as Language | undefined) ?? 'en';
}

function read(): Preferences {
  const chosen: Preferences = { language: browserLanguage(), theme: 'system' };
  try {
    const kept = JSON.parse(localStorage.getItem(kKey) ?? '{}') as Partial<Preferences>;
    if (kept.language && kept.language in languages) chosen.language = kept.language;
    if (kept.theme === 'light' || kept.theme === 'dark') chosen.theme = kept.theme;
  } catch {
    // Unreadable or forbidden storage: the browser's own wishes apply.
  }
  return chosen;
}

export const preferences: Preferences = read();

export function keepPreferences(changed: Partial<Preferences>): void {
  Object.assign(preferences, changed);
  try {
    localStorage.setItem(kKey, JSON.stringify(preferences));
  } catch {
    // They last as long as the page.
  }
}

export function showTheme(theme: Theme): void {
  if (theme === 'system') delete document.documentElement.dataset.theme;
  else document.documentElement.dataset.theme = theme;
}
