// A role, from the lowest to the highest.
import { kRoles } from '../api/permissions';
import { texts } from '../texts/texts';

interface Props {
  label: string;
  /// The choice of no role; absent: one has to be chosen.
  none?: string;
  value: string;
  onChange: (role: string) => void;
}

export function RoleSelect({ label, none, value, onChange }: Props) {
  return (
    <label>
      {label}
      <select value={value} onChange={(e) => onChange(e.currentTarget.value)}>
        {none !== undefined && <option value="">{none}</option>}
        {kRoles.map((role) => <option key={role} value={role}>{texts().session.roles[role]}</option>)}
      </select>
    </label>
  );
}
