(expect CEN0581 2:11)
P1=[-2]**2
