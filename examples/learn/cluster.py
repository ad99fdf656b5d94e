"""Runs the sweep of map.toml on the workers of a Dask cluster."""

import flapwing
from dask.distributed import Client, LocalCluster

if __name__ == "__main__":
    with LocalCluster(n_workers=2, threads_per_worker=1) as cluster, Client(cluster) as client:
        table = flapwing.sweep("map.toml", client=client, out="dask.csv")
    print(table.counts)
