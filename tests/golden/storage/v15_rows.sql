-- What v15.sql has more than v14.sql: a run that is being executed, with the setup of its gateway and a called program.
INSERT INTO run (id, machine, program, revision, control, state, sent, accepted, executed, line, sequence, reason, author, created_us, sha256, gateway_setup)
  SELECT 'r2', 1, 1, 2, control, 'active', 0, 0, 0, 0, -1, '', author, created_us, (SELECT sha256 FROM revision WHERE program = 1 AND number = 2),
  'aaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaa' FROM run WHERE id = 'r1';
INSERT INTO run_call SELECT run.number, '1', 1, 1, revision.sha256 FROM run JOIN revision ON revision.program = 1 AND revision.number = 1 WHERE run.id = 'r2';
DELETE FROM event WHERE id = (SELECT max(id) FROM event);
