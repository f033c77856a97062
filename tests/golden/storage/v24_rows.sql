-- What v24.sql has more than v23.sql: a program without a run that began after the run r1.
UPDATE port_transfer SET after_run = 'r1' WHERE direction = 'send';
