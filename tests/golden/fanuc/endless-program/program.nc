(expect loop-limit 2:0)
M99
