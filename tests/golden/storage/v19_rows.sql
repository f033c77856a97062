-- What v19.sql has more than v18.sql: the time and the path of a run.
UPDATE run SET motion_seconds = 12.5, path_mm = 250.75 WHERE id = 'r1';
