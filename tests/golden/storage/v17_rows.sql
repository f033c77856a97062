-- What v17.sql has more than v16.sql: an archive of measurements whose parts are counted, a job that counts good parts, a machine that is held.
INSERT INTO archive VALUES(2,'measurements','',0,1,2,1,'measurements-1.jsonl.zst',X'0000000000000000000000000000000000000000000000000000000000000000',4,120,1700000000000000,1700000000000001,1700000000000016,1);
INSERT INTO archived_part VALUES('r1',2,'bore',0,2);
INSERT INTO job (machine, position, program, revision, quantity, parts_per_run, comment, author, created_us, counts) VALUES(1,2,1,NULL,5,1,'','anna',1700000000000016,'good');
INSERT INTO machine_hold VALUES(1,'r2','report template bore version 1','part 1 S7 is scrap',1700000000000017);
