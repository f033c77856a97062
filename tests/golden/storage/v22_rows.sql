INSERT INTO port_transfer SELECT min(name), 'send', 'transfer-1', 'p.nc revision 1' || char(10) || 'p.nc revision 2', 26, 12, 26, 'active', '', 1700000000000000, NULL FROM port;
INSERT INTO port_transfer SELECT min(name), 'receive', 'reception-1', '', 0, 100, 100, 'interrupted', 'the line is lost', 1700000000000000, 1700000001000000 FROM port;
