"""From the problem statement to gains and bounds; each part stands alone and runs in parallel with the others."""
