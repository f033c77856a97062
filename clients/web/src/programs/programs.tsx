// The programs: all of them or those that a search finds (#/programs?words=pocket), or one with its revisions (#/programs/O0100, #/programs/O0100/3?line=12).
import { ProgramList } from './program_list';
import { ProgramPage } from './program';

export default function ProgramsView({ path, query }: { path: string[]; query: URLSearchParams }) {
  const [name, number] = path;
  if (name === undefined) return <ProgramList query={query} />;
  return <ProgramPage key={name} name={name} number={number === undefined ? null : Number(number)} line={Number(query.get('line')) || null} />;
}
