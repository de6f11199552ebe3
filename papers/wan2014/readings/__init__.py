"""What the claims are held against; one module per topic."""
