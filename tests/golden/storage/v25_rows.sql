-- What v25.sql has more than v24.sql: a revision that came into force before any run, and was withdrawn after all of them.
UPDATE revision SET in_force_after = 0, withdrawn_after = 4 WHERE number = 1 AND program = (SELECT id FROM program WHERE name = 'p.nc');
