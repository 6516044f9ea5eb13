# To be written with the first install test.
