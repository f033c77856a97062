// Hands a file of the API to the browser. A plain link could not carry the sign-in.
import { fetchApi } from '../api/request';

export async function download(path: string, name: string): Promise<void> {
  const blob = await (await fetchApi('GET', path)).blob();
  const link = document.createElement('a');
  link.href = URL.createObjectURL(blob);
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 60_000);
}
