"""Parts of the synthesis stage; paper.yaml names them."""
