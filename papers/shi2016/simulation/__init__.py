"""Parts of the simulation stage; paper.yaml names them."""
