(expect NGC0121 2:12)
G0 X[-2**.5]
M2
