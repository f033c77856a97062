-- What v16.sql has more than v15.sql: a reader of the records that has not got the last of them.
INSERT INTO record_reader VALUES ('mqtt', 1700000000000000);
INSERT INTO record_cursor SELECT 'mqtt', machine, epoch, 2 FROM record_epoch WHERE machine = 1;
