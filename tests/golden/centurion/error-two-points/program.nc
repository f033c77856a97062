(expect CEN0551 2:2)
X1.2.3
