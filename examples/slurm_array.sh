#!/bin/sh
# One sweep on several machines: a Slurm array job of eight tasks, each of which runs an eighth of the points.
#
#   sbatch examples/slurm_array.sh grid.toml
#
# When all tasks are done:
#
#   flap merge grid.csv grid.*of8.csv
#
# A task that was killed, preempted or ran out of time goes on where it was when it is submitted again, alone if need be:
#
#   sbatch --array=3 examples/slurm_array.sh grid.toml

#SBATCH --job-name=flap
#SBATCH --array=1-8
#SBATCH --cpus-per-task=16
#SBATCH --time=12:00:00
#SBATCH --requeue
#SBATCH --signal=B:TERM@60

# As many as the array has when it is whole: Slurm's own count is of the tasks submitted together.
shards=8

exec flap sweep --grid "$1" --shard "$SLURM_ARRAY_TASK_ID/$shards" --threads "$SLURM_CPUS_PER_TASK" --resume
