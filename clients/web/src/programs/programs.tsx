// The programs: all of them, or one with its revisions (#/programs/O0100, #/programs/O0100/3).
import { ProgramList } from './program_list';
import { ProgramPage } from './program';

export default function ProgramsView({ path }: { path: string[] }) {
  const [name, number] = path;
  return name === undefined ? <ProgramList /> : <ProgramPage name={name} number={number === undefined ? null : Number(number)} />;
}
