# One job per (ℬ, θ₀), and on request a second opinion on each.


rule simulate:
    output:
        "results/trajectories/B{B}_k{k}.parquet",
    log:
        "results/logs/simulate/B{B}_k{k}.log",
    group:
        "simulations"
    params:
        code=code_of("simulate"),
        options=SIMULATE_OPTIONS,
    shell:
        "sedfiber simulate --B {wildcards.B} --angle-index {wildcards.k} {params.options}"
        " -o {output} > {log} 2>&1"


rule tabulate_trajectories:
    input:
        **{split: trajectories(split) for split in STUDY.splits},
    output:
        "results/tables/trajectories.csv",
    log:
        "results/logs/tabulate_trajectories.log",
    resources:
        mem_mb=2000,
    params:
        code=code_of("tabulate_trajectories"),
        settings=as_json({"splits": {split: trajectories(split) for split in STUDY.splits}}),
    shell:
        "sedfiber tabulate_trajectories --settings {params.settings:q} -o {output} > {log} 2>&1"


rule tabulate_audit:
    input:
        [trajectories(split) for split in STUDY.splits],
    output:
        "results/tables/audit.csv",
    log:
        "results/logs/tabulate_audit.log",
    params:
        code=code_of("tabulate_audit"),
    shell:
        "sedfiber tabulate_audit {input} -o {output} > {log} 2>&1"


rule simulations:
    input:
        [trajectories(split) for split in STUDY.splits],
        rules.tabulate_trajectories.output,
        rules.tabulate_audit.output,


rule check_simulation:
    input:
        "results/trajectories/B{B}_k{k}.parquet",
    output:
        "results/checks/B{B}_k{k}.json",
    log:
        "results/logs/check_simulation/B{B}_k{k}.log",
    group:
        "checks"
    params:
        code=code_of("check_simulation"),
        settings=as_json(config["check"]),
    shell:
        "sedfiber check_simulation {input} --settings {params.settings:q} -o {output} > {log} 2>&1"


rule tabulate_checks:
    input:
        [f"results/checks/B{B}_k{k}.json" for split in STUDY.splits for B, k in STUDY.runs(split)],
    output:
        "results/tables/simulation_checks.csv",
    log:
        "results/logs/tabulate_checks.log",
    params:
        code=code_of("tabulate_checks"),
    shell:
        "sedfiber tabulate_checks {input} -o {output} > {log} 2>&1"


rule check_simulations:
    input:
        rules.tabulate_checks.output,
