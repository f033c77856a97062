G0 X[2**3**2] Y[1+1 AND 0] Z[-2**2]
X[-7 MOD 3] Y[7 MOD -3] Z[5-3*2/4]
X[1 OR 0] Y[1 XOR 1] Z[4 AND 0.5]
M2
