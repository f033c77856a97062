// What the API has of templates, as the views take it.
import type { ReportTemplateText, TemplateAssignment, TemplateAssignments } from '../../generated/api';
import { get, getIfThere, pathOf } from '../api/request';
import { useLoaded, type Loaded } from '../parts/use_loaded';

export function useAssignments(): Loaded<TemplateAssignments> {
  return useLoaded((signal) => get<TemplateAssignments>(pathOf('report-template-assignments'), {}, signal), []);
}

/// The newest, or that version; null: there is none of this name yet.
export async function loadTemplate(name: string, version: number | null, signal?: AbortSignal): Promise<ReportTemplateText | null> {
  const path = pathOf('report-templates', name);
  return version === null ? getIfThere<ReportTemplateText>(path, {}, signal) : get<ReportTemplateText>(path, { version }, signal);
}

export function ofTemplate(assignments: TemplateAssignment[], name: string): TemplateAssignment[] {
  return assignments.filter(({ template }) => template === name);
}

/// Every version there is, the newest first: they are counted from 1 and none is taken away.
export function versionsUpTo(newest: number): number[] {
  return Array.from({ length: newest }, (_, i) => newest - i);
}
