(expect NGC0133 2:6)
G0 X#<nothing>
M2
