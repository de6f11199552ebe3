"""What was found, claim by claim; claims.yaml names the functions as ``topic.function``."""
