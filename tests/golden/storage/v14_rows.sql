-- What v14.sql has more than v13.sql: a file of a hot folder that is stored and not moved, a job with a run, a held queue, and a
-- webhook that has not got its last event. The webhook comes last: it makes every change an event.
INSERT INTO folder_file (folder, name, sha256, size, changed_ns, state, program, revision, reason, target, taken_us)
  SELECT 'cam', 'p.nc', sha256, 11, 1700000000000000000, 'stored', 'p.nc', 2, '', 'done/p.nc', 1700000000000000
  FROM revision WHERE program = 1 AND number = 2;
INSERT INTO job (machine, position, program, revision, quantity, parts_per_run, comment, author, created_us)
  VALUES (1, 1, 1, NULL, 3, 1, 'steel', 'anna', 1700000000000000);
UPDATE run SET job = 1 WHERE id = 'r1';
INSERT INTO job_hold VALUES (1, 'quality', 'bore is wide', 1700000000000000);
INSERT INTO event (time_us, kind, data) VALUES (1700000000000000, 'run', '{"run":"r1"}');
INSERT INTO webhook (name, url, secret, kinds, author, created_us, delivered) VALUES ('erp', 'https://erp.example/', 's3cret', 'run,alarm', 'admin', 1700000000000000, 0);
