# Installing comes with the first test of it.
