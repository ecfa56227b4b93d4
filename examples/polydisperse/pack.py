#!/usr/bin/python3
"""Writes points.csv: balls of 4 to 10 mm radius at random in a box of 100 mm, none overlapping, the largest first.

    examples/polydisperse/pack.py > points.csv
"""

import random

SIZE, COUNT, LEAST, MOST = 0.1, 400, 0.004, 0.010

random.seed(1)
radii = sorted((LEAST * (MOST / LEAST) ** random.random() ** 2 for _ in range(COUNT)), reverse=True)
balls = []
for r in radii:
    for _ in range(200000):
        ball = [random.uniform(r, SIZE - r) for _ in range(3)] + [r]
        if all(sum((a - b) ** 2 for a, b in zip(ball[:3], other[:3])) > (r + other[3]) ** 2 for other in balls):
            balls.append(ball)
            break
print("x,y,z,radius")
for ball in balls:
    print(",".join(f"{value:.6f}" for value in ball))
