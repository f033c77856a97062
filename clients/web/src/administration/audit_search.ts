// The entries that have every word of a filter, in any field. Pure.
import type { AuditEntry } from '../../generated/api';

export function searchEntries(entries: AuditEntry[], filter: string): AuditEntry[] {
  const words = filter.toLowerCase().split(/\s+/).filter((word) => word !== '');
  return entries.filter((entry) => {
    const text = [entry.who, entry.action, entry.subject, entry.detail, entry.credential, entry.address].join(' ').toLowerCase();
    return words.every((word) => text.includes(word));
  });
}
