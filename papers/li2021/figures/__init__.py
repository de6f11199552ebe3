"""The paper's figures redrawn, and those that show the findings."""
