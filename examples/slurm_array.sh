#!/bin/sh
# One sweep on several machines: a Slurm array job of eight tasks, each of which runs an eighth of the points.
#
#   sbatch examples/slurm_array.sh grid.toml
#
# When all tasks are done:
#
#   flap results merge grid.csv grid.*of8.csv
#
# If a task was killed, preempted or ran out of time, submit it again, alone if need be. It continues its sweep:
#
#   sbatch --array=3 examples/slurm_array.sh grid.toml

#SBATCH --job-name=flap
#SBATCH --array=1-8
#SBATCH --cpus-per-task=16
#SBATCH --time=12:00:00
#SBATCH --requeue
#SBATCH --signal=B:TERM@60

# The number of tasks of the whole array: Slurm's own count is that of the tasks submitted together.
shards=8

exec flap sweep "$1" --shard "$SLURM_ARRAY_TASK_ID/$shards" --threads "$SLURM_CPUS_PER_TASK"
