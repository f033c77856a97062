// Where the page begins: the language is loaded, then the page is shown.
import { render } from 'preact';
import { App } from './app/app';
import { preferences, showTheme } from './app/preferences';
import { loadTexts } from './texts/texts';

showTheme(preferences.theme);
await loadTexts(preferences.language);
render(<App />, document.getElementById('app')!);
