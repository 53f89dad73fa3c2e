"""What the thesis prints and more than one section compares with."""

TABLE_4_4_HZ = {2: 66, 3: 47, 4: 28}  # grids a second, by the number of LUX
MOST_POINTS = 16 * 200                # of a frame: section 4.1.4, 16 layers of up to 200 points
