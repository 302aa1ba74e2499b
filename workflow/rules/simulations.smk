# One job per (ℬ, θ₀), and on request a second opinion on each.


rule simulate:
    input:
        sources("simulate"),
    output:
        "results/trajectories/B{B}_k{k}.parquet",
    log:
        "results/logs/simulate/B{B}_k{k}.log",
    benchmark:
        "results/benchmarks/simulate/B{B}_k{k}.tsv"
    conda:
        "../../envs/simulate.yaml"
    threads: 1
    resources:
        mem_mb=500,
        runtime=5,
    params:
        options=STUDY.simulate_options,
    message:
        "simulate B={wildcards.B}, theta0={wildcards.k}π/48"
    shell:
        "sedfiber simulate --B {wildcards.B} --angle-index {wildcards.k} {params.options}"
        " -o {output} > {log} 2>&1"


rule tabulate_trajectories:
    input:
        sources("tabulate_trajectories"),
        **{split: trajectories(split) for split in STUDY.splits},
    output:
        "results/tables/trajectories.csv",
    log:
        "results/logs/tabulate_trajectories.log",
    benchmark:
        "results/benchmarks/tabulate_trajectories.tsv"
    conda:
        "../../envs/analysis.yaml"
    threads: 1
    resources:
        mem_mb=2000,
        runtime=10,
    params:
        splits=lambda wildcards, input: " ".join(
            f"--split {split} {' '.join(input[split])}" for split in STUDY.splits
        ),
    message:
        "tabulate all trajectories"
    shell:
        "sedfiber tabulate_trajectories {params.splits} -o {output} > {log} 2>&1"


rule simulations:
    input:
        [trajectories(split) for split in STUDY.splits],
        rules.tabulate_trajectories.output,
