UPDATE port SET host = 'srv-1' WHERE name = (SELECT min(name) FROM port);
