-- Version 19: what a run's gateway reports of its time and its path, for the statistics that controls show of a fed program.

-- NULL: from an older gateway, or cut off.
ALTER TABLE run ADD COLUMN motion_seconds REAL CHECK (motion_seconds >= 0);  -- of moves and dwells, by the machine's time
ALTER TABLE run ADD COLUMN path_mm REAL CHECK (path_mm >= 0);                -- of the executed blocks
