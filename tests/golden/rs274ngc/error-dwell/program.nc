(expect NGC0220 2:0)
G4 M3
M2
