(expect NGC0292 2:1)
o2 else
M2
