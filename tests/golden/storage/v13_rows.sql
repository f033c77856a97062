-- What v13.sql has more than v12.sql: what a program is for, an attachment, a release that pins what its program calls.
UPDATE program SET part = '4711', machine_group = 'lathes' WHERE id = 1;
UPDATE revision SET cam_file = 'p.f3d' WHERE program = 1 AND number = 2;
INSERT INTO attachment (program, revision, name, content, sha256, comment, author, created_us)
  SELECT 1, NULL, 'setup.txt', content, sha256, 'side 1', 'anna', 1700000000000000 FROM revision WHERE program = 1 AND number = 1;
